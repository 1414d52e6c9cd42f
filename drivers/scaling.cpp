#include "drivers/studies/scaling/program.hpp"

int main(int argc, char** argv) { return breccia::run_scaling_program(argc, argv); }
