#include "drivers/programs/laboratory.hpp"

int main(int argc, char** argv) { return breccia::run_laboratory_test("cut", argc, argv); }
