// The program breccia-layouts: the bond loop with bonds and particles stored, and forces summed, in
// other ways.
#pragma once

namespace breccia {

/// Writes OUT/layouts.csv and OUT/layouts.json, anew after each specimen and number of threads.
/// @returns the exit code; 1 where a layout does not compute what production does
int run_layouts_program(int argc, char** argv);

}  // namespace breccia
