// How the time of a step changes with the number of threads: one uniaxial compression of a packed
// concrete cylinder, measured in blocks of steps.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/base/median_and_range.hpp"
#include "core/elastic/area_factor.hpp"
#include "core/loading/curve_row.hpp"
#include "core/world/world.hpp"

namespace breccia {

/// strong: the same specimen on more threads. weak: as many spheres for each thread.
enum class ScalingStudy { strong, weak };

struct ScalingPoint {
  ScalingStudy study = ScalingStudy::strong;
  ScatterKind scatter = ScatterKind::private_sums;
  int threads = 1;
  std::size_t spheres = 0;
  Precision precision = Precision::single;

  /// How the loop computes and sums.
  std::pair<Precision, ScatterKind> way() const { return {precision, scatter}; }
};

/// The steps of a point, counted from the start of the test.
struct ScalingBlocks {
  /// A row of the curve is closed (energies, broken bonds) every so many steps, as in the middle of
  /// a test of usual length; blocks are whole rows.
  static constexpr std::size_t steps_per_row = 20;
  /// In all: 2 % of strain take longer than this with 100 spheres or more.
  static constexpr std::size_t most_steps = 20'000;
  std::size_t warm_up = 100;  ///< steps before the first block: caches fill, the threads wake up
  std::size_t steps = 200;    ///< in each block
  std::size_t repeat = 5;     ///< blocks

  std::size_t all_steps() const { return warm_up + steps * repeat; }
};

/// Cylinder, packed and bonded once, with the area factor of an affine deformation: it takes no
/// elastic probe, and the work of a step does not depend on it.
struct ScalingSpecimen {
  Assembly assembly;
  AreaFactor factor;
};

/// 150 x 300 mm, the size of the published tests.
inline constexpr Body scaling_body{Shape::cylinder, 0.15, 0, 0.3};
/// m/s, of each platen.
inline constexpr double scaling_speed = 0.1;

ScalingSpecimen make_scaling_specimen(std::size_t spheres, const Material& material, int threads);

/// What was measured at one point.
struct ScalingRun {
  ScalingPoint point;
  int ranks = 1;
  std::size_t halo_rows = 0;          ///< of particles that a rank gets from others at every step, the most
  double imbalance = 0;               ///< bonds that a rank computes, the most over the mean, less 1
  std::size_t bonds = 0, broken = 0;  ///< broken: at the end
  std::size_t steps = 0;              ///< in each block
  std::vector<double> seconds;        ///< wall time of each block, whole steps: what a test spends on them
  Phases phases;                      ///< of all blocks
  double alpha = 0, time_step = 0;    ///< 1, s
  std::size_t table_bytes = 0;        ///< columns of particles, bonds and contacts
  std::size_t peak_bytes = 0;         ///< largest resident set of the process while the point was measured
  std::string state_hash;             ///< at the end

  double all_seconds() const;  ///< of all blocks
};

/// Called about ten times a second at most: the fraction of the point's steps done, and the present
/// row.
using ScalingProgress = std::function<void(const World&, double, const CurveRow&)>;

/// The test as breccia-ucs runs it, from rest, on at most as many threads as the point says.
/// @param blocks  at most `most_steps` in all
/// @param ranks   all of them call; what the root returns counts
/// @throws SimulationBroke
ScalingRun measure_scaling(const ScalingSpecimen& specimen, const Material& material,
                           const ScalingPoint& point, const ScalingBlocks& blocks,
                           const ScalingProgress& progress = {}, const Ranks& ranks = {});

/// s, over the blocks.
MedianAndRange step_time(const ScalingRun& run);

/// Bonds times steps per second, by the median.
double bond_updates(const ScalingRun& run);

/// Of all tables together, spheres and contacts too.
double table_bytes_per_bond(const ScalingRun& run);

/// Speed-up: bond updates per second over those of the run with the fewest threads in the same
/// series (of one specimen that is t_1/t_n). Efficiency: speed-up over the ratio of threads.
struct ScalingGain {
  double speed_up = 1, efficiency = 1;
};
ScalingGain gain_of(const ScalingRun& run, const std::vector<ScalingRun>& runs);

}  // namespace breccia
