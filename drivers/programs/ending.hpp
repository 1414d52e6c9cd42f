// How a program ends badly: one line and an exit code, whatever was thrown.
#pragma once
#include <exception>
#include <string>

namespace breccia {

struct Ending {
  std::string what;  ///< one line
  int code = 0;      ///< 2 bad input, 3 the simulation broke, 4 files
};

/// What an exception means to who started the program. Any exception: what nobody thought of ends
/// with 3.
Ending ending_of(const std::exception_ptr& thrown);

/// For what is thrown where nothing catches it, as in a worker thread: a line and an exit code
/// instead of an abort.
/// @param program  its whole name, for the line; kept
void end_in_order(const std::string& program);

/// Starts so many threads less one at once and lets them go again: a limit on threads or memory is
/// met here, and not in the middle of a run, within a library.
/// @throws SimulationBroke when they cannot be started
void try_threads(int threads);

}  // namespace breccia
