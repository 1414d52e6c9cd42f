// The program breccia-stability: stiff and extreme scenes at fractions of the largest stable step.
#pragma once

namespace breccia {

/// Writes OUT/stability.csv and OUT/stability.json, anew after each scene.
/// @returns the exit code; 1 where something is amiss
int run_stability_program(int argc, char** argv);

}  // namespace breccia
