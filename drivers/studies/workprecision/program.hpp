// breccia-workprecision: the error of a test against the time that it takes.
#pragma once

namespace breccia {

/// @returns the exit code
int run_workprecision_program(int argc, char** argv);

}  // namespace breccia
