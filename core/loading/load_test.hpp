// A laboratory test between two platens: hydrostatic stage where there is confinement, then loading
// at constant speed and pressure. Compression, tension, direct shear, and the hydrostatic stage
// alone. docs/model.md, "Laboratory tests".
#pragma once
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/checks/stability_checks.hpp"
#include "core/loading/plan.hpp"
#include "core/loading/recorder.hpp"
#include "core/world/world.hpp"

namespace breccia {

/// no_rest: the specimen did not come to rest under its confinement, so that nothing was loaded.
enum class Stopped { strain, peak_drop, pressure, interrupted, no_rest };

/// When a specimen was unloaded and loaded again, s.
struct Cycle {
  double unloaded = 0, reloaded = 0;
};

struct LoadResult {
  Recorder record;  ///< rows of stage 2 (hydrostatic: of stage 1); strains from its start
  std::vector<Cycle> cycles;
  Stopped stopped = Stopped::strain;
  std::uint64_t stage1_steps = 0;
  std::uint64_t stage1_broken = 0, stage1_yielded = 0;              ///< bonds, at the end of stage 1
  double held_pressure = std::numeric_limits<double>::quiet_NaN();  ///< Pa, at the end of stage 1; NaN: none
  double run_time = 0;                                              ///< s, wall, of both stages
  std::vector<std::string> warnings;
};

/// Where the platens are going: on, back while the specimen is unloaded, on again.
struct LoadPath {
  double sense = 1;      ///< -1 while unloading
  double turned_at = 0;  ///< platen strain at which the last unloading began
  double load = 0;       ///< Pa, deviator there
};

enum class Stage : std::uint64_t { not_begun, pressing, loading };

/// Where a test stands, between two rows of its curve: with the world and the result, all that it
/// needs to go on.
struct LoadState {
  Stage stage = Stage::not_begun;
  double stage_start = 0;  ///< s
  double pressure = 0;     ///< Pa, of an evenly rising one
  double speed = 0;        ///< m/s, of the platens
  double peak = 0;         ///< Pa, so far
  Datum zeros;
  std::vector<Gid> left_out;  ///< of the gauges: what had come loose when they were set to zero
  LoadPath direction;
  std::size_t next_unloading = 0;  ///< in LoadTest::unload_at
  std::size_t frames = 0;          ///< taken
  std::size_t cracks_told = 0;
  StabilityChecks checks;
};

/// What a program does between steps: none of it changes the state, but for columns made for
/// output.
struct LoadHooks {
  std::function<bool()> interrupted;  ///< true ends the run with what there is
  /// about ten times a second at most: stage (1, 2), fraction of it done, and the present row
  std::function<void(int, double, const CurveRow&)> progress;
  std::function<void(World&, std::size_t frame, const CurveRow&)> frame;  ///< called on every rank
  std::function<void(std::span<const Crack>)> cracks;                     ///< new ones since the row before
  std::function<bool()> checkpoint_due;  ///< asked between rows; an interrupted run makes one without asking
  /// called on every rank, when its books have been brought together
  std::function<void(World&, const LoadState&, const LoadResult&)> checkpoint;
};

/// Runs a test from where it stands to its end, or until it is interrupted.
/// @param state   of a test not begun, or with the world and the result from a checkpoint
/// @param result  filled as the run goes, so that what there is survives an exception
/// @throws SimulationBroke when a guard stops it, see core/checks/stability_checks.hpp
void run_load_test(World& world, const Assembly& assembly, const LoadTest& test, const LoadHooks& hooks,
                   LoadState& state, LoadResult& result);

/// The same from the start.
void run_load_test(World& world, const Assembly& assembly, const LoadTest& test, const LoadHooks& hooks,
                   LoadResult& result);

}  // namespace breccia
