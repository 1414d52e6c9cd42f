#include "drivers/programs/laboratory.hpp"

int main(int argc, char** argv) {
  return breccia::run_laboratory_test(
      "usc", "Uniaxial strain compression: a cylinder whose mantle cannot move sideways.", argc, argv,
      breccia::run_test_program);
}
