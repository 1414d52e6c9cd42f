// The programs of the laboratory tests: a specimen, one run per confinement, the results.
#pragma once
#include "io/command_line.hpp"

namespace breccia {

/// @throws BadInput, SimulationBroke, FileTrouble
void run_test_program(const CommandLine& line);

}  // namespace breccia
