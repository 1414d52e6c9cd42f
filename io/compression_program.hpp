// The programs breccia-ucs and breccia-triaxial: a specimen, one run per confinement, the results.
#pragma once
#include "io/command_line.hpp"

namespace breccia {

/// @throws BadInput, SimulationBroke, FileTrouble
void run_compression_program(const CommandLine& line);

}  // namespace breccia
