#include "drivers/studies/workprecision/program.hpp"

int main(int argc, char** argv) { return breccia::run_workprecision_program(argc, argv); }
