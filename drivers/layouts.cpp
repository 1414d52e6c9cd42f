#include "io/layouts_program.hpp"

int main(int argc, char** argv) { return breccia::run_layouts_program(argc, argv); }
