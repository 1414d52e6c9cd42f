// A compression test: hydrostatic stage where there is confinement, then axial loading at constant speed and
// pressure. MODEL section 10.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/gauges.hpp"
#include "core/recorder.hpp"
#include "core/world.hpp"

namespace breccia {

struct CompressionTest {
  double confinement = 0;     ///< Pa
  double platen_speed = 0.1;  ///< m/s, of each platen
  double stop_strain = 0.02;  ///< platen travel over height since the end of stage 1
  double stop_after_peak =
      0.5;          ///< ends when the deviator has fallen by this fraction of its peak; 0 = never
  int frames = 20;  ///< pictures of the state over the whole strain, and one at the end; 0 = none
};

enum class Stopped { strain, peak_drop, interrupted };

struct CompressionResult {
  Recorder record;  ///< rows of stage 2; strains from its start
  Stopped stopped = Stopped::strain;
  std::uint64_t stage1_steps = 0;
  double run_time = 0;  ///< s, wall, of both stages
  std::vector<std::string> warnings;
};

/// What a program does between steps: none of it changes the state.
struct CompressionHooks {
  std::function<bool()> interrupted;  ///< true ends the run with what there is
  /// about ten times a second at most: stage (1, 2), fraction of it done, and the present row
  std::function<void(int, double, const CurveRow&)> progress;
  std::function<void(const World&, const CurveRow&)> frame;
};

/// @param result  filled as the run goes, so that what there is survives an exception
/// @throws SimulationBroke when a number is not finite
void run_compression(World& world, const Assembly& assembly, const CompressionTest& test,
                     const CompressionHooks& hooks, CompressionResult& result);

}  // namespace breccia
