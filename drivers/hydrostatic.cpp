#include "drivers/programs/laboratory.hpp"

int main(int argc, char** argv) {
  return breccia::run_laboratory_test("hydrostatic",
                                      "Hydrostatic compression of a cylinder up to a pressure.", argc, argv,
                                      breccia::run_test_program);
}
