#include "drivers/programs/laboratory.hpp"

int main(int argc, char** argv) {
  return breccia::run_laboratory_test("bts",
                                      "Brazilian test: a disc pressed along a diameter between two strips.",
                                      argc, argv, breccia::run_test_program);
}
