#include "io/scaling_program.hpp"

int main(int argc, char** argv) { return breccia::run_scaling_program(argc, argv); }
