// One line that says how far a run is: redrawn on a terminal, now and then in a file.
#pragma once
#include <chrono>
#include <string>

#include "core/loading/curve_row.hpp"
#include "core/world/world.hpp"

namespace breccia {

struct Progress {
  bool quiet = false;
  bool terminal = false;
  std::string title;                              ///< "run 2/4, 4.5 MPa"
  std::chrono::steady_clock::time_point start{};  ///< of the run
  std::chrono::steady_clock::time_point last{};   ///< line
  bool drawn = false;                             ///< a line is on the terminal
};

Progress make_progress(bool quiet);

/// A new run begins.
void begin(Progress& progress, const std::string& title);

/// @param stage     1 hydrostatic, 2 axial
/// @param fraction  of the stage that is done; the time left follows from it and is an upper bound,
///                  since a run ends when the specimen has failed
void tell(Progress& progress, const World& world, int stage, double fraction, const CurveRow& row);

/// Any other line; clears the redrawn one first. Both throw WriteError when nobody can read them.
void say(Progress& progress, const std::string& line);

}  // namespace breccia
