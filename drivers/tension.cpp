#include "drivers/programs/laboratory.hpp"

int main(int argc, char** argv) {
  return breccia::run_laboratory_test("tension", "Direct tension of a cylinder or box with glued ends.", argc,
                                      argv, breccia::run_test_program);
}
