#include "drivers/studies/layouts/program.hpp"

int main(int argc, char** argv) { return breccia::run_layouts_program(argc, argv); }
