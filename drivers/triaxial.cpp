#include "drivers/programs/laboratory.hpp"

int main(int argc, char** argv) {
  return breccia::run_laboratory_test(
      "triaxial",
      "Triaxial compression of a cylinder: one run per confinement, and the envelope of the peaks.", argc,
      argv, breccia::run_test_program);
}
