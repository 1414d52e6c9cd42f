#include "drivers/studies/stability/program.hpp"

int main(int argc, char** argv) { return breccia::run_stability_program(argc, argv); }
