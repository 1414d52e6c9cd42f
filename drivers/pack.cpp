#include "drivers/programs/pack_program.hpp"

int main(int argc, char** argv) {
  return breccia::run_program("pack", "Dense random packings of spheres in cylinders, discs and boxes.", argc,
                              argv, breccia::run_pack_program);
}
