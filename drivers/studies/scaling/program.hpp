// The program breccia-scaling: how the time of a step changes with the number of threads.
#pragma once

namespace breccia {

/// Writes OUT/scaling.csv and OUT/scaling.json, anew after each point.
/// @returns the exit code
int run_scaling_program(int argc, char** argv);

}  // namespace breccia
