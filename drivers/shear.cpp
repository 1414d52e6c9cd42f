#include "drivers/programs/laboratory.hpp"

int main(int argc, char** argv) {
  return breccia::run_laboratory_test(
      "shear", "Direct shear of a cylinder or box at half its height, one run per normal stress.", argc, argv,
      breccia::run_test_program);
}
