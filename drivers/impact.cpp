#include "drivers/programs/impact_program.hpp"
#include "io/impact_cases/impact_case.hpp"
#include "io/impact_cases/impact_reference.hpp"

int main(int argc, char** argv) {
  return breccia::run_program("impact", "Free particles against each other and walls.", argc, argv,
                              breccia::run_impact_program, breccia::describe_impact_keys(), false,
                              breccia::impact_reference);
}
