#include "io/workprecision_program.hpp"

int main(int argc, char** argv) { return breccia::run_workprecision_program(argc, argv); }
