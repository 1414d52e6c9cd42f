#include "drivers/programs/laboratory.hpp"

int main(int argc, char** argv) {
  return breccia::run_laboratory_test("biaxial",
                                      "Biaxial compression of a rectangle of discs: one run per confinement.",
                                      argc, argv, breccia::run_test_program);
}
