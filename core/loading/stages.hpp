// The stages of a laboratory test, and what each of them does between two steps: read, tell,
// picture, checkpoint.
#pragma once
#include <chrono>

#include "core/loading/instruments.hpp"
#include "core/loading/load_test.hpp"

namespace breccia {

/// What a run needs at hand.
struct Run {
  World& w;
  const Assembly& assembly;
  const LoadTest& test;
  const LoadHooks& hooks;
  LoadState& state;
  LoadResult& result;
  double run_time_before = 0;  ///< s, of the part up to the checkpoint that this one goes on from
  std::chrono::steady_clock::time_point begun = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point told{};  ///< when the program was last told

  bool interrupted() const { return hooks.interrupted && hooks.interrupted(); }
  bool is_root() const { return w.partition.ranks.is_root(); }
};

/// 0 to 1 without a jump in speed. (B65)
double eased(double t, double duration);

/// s, for a wave to run from end to end. (B65)
double crossing_time(const World& w, const Assembly& a);

/// Broken bonds and energies at the end of a row.
CurveRow state_row(World& w);

/// A stage begins now.
void enter(Run& run, Stage stage);

/// Brings the result's run time up to now.
void note_run_time(Run& run);

/// Tells a program how far a run is, a few times a second, and what has cracked.
void tell(Run& run, int stage, double fraction, const CurveRow& row);

/// Pictures of the state, evenly spaced over the run, and one at its end.
void frame_if_due(Run& run, double done, const CurveRow& row, bool last);

/// Makes a checkpoint where one is due, or the run is interrupted.
/// @returns true when the run is to end here, interrupted
bool checkpoint_if_due(Run& run);

/// The pressure on the lateral surface and on the platens; a shear box has it on its lid alone.
void set_pressure(const Run& run, double pressure);

/// The instruments of a stage that is recorded: set to zero, and a first picture taken, unless a
/// checkpoint was made in it.
Instruments begin_or_go_on(Run& run, Stage stage);

/// Stage 1: the pressure rises until the specimen rests under it. (B67)
/// @returns false when interrupted, or when it does not come to rest: a stage that has not cannot
///          be followed by the next
bool press_hydrostatically(Run& run);

/// The hydrostatic stage as a test of its own: the pressure rises evenly, at the rate at which an
/// elastic specimen between platens of the given speed would take it up. (B68)
void press_evenly(Run& run);

/// Stage 2: platens at constant speed, after a ramp without a jump.
void load(Run& run);

}  // namespace breccia
