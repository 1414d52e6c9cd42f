// The program breccia-impact: particles against each other and walls.
#pragma once
#include "drivers/programs/command_line.hpp"

namespace breccia {

/// Writes OUT/case.toml, summary.json and curve-0.csv; the curve also where the simulation broke.
/// @throws BadInput, SimulationBroke, WriteError
void run_impact_program(const CommandLine& line);

}  // namespace breccia
