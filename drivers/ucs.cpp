#include "drivers/programs/laboratory.hpp"

int main(int argc, char** argv) {
  return breccia::run_laboratory_test("ucs", "Unconfined compression of a cylinder between two platens.",
                                      argc, argv, breccia::run_test_program);
}
