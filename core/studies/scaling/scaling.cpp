#include "core/studies/scaling/scaling.hpp"

#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <numeric>

#include "core/base/process_memory.hpp"
#include "core/distributed/distribute.hpp"
#include "core/distributed/gather.hpp"
#include "core/loading/load_test.hpp"
#include "core/packing/packing.hpp"
#include "core/tables/state_hash.hpp"
#include "core/world/energies.hpp"
#include "core/world/make_world.hpp"

namespace breccia {
namespace {

using Clock = std::chrono::steady_clock;

/// Cuts a running test into blocks. A block ends where the next one begins: nothing between steps
/// is left out.
class BlockClock {
public:
  BlockClock(const ScalingBlocks& blocks, ScalingRun& run) : blocks_(blocks), run_(run) {}

  /// Called when a row is closed; true when the last block is over.
  bool tick(const World& w) {
    if (w.step < blocks_.warm_up) return false;
    const std::size_t since = w.step - blocks_.warm_up;
    if (since % blocks_.steps != 0) return false;
    const auto now = Clock::now();
    if (since > 0) {
      run_.seconds.push_back(std::chrono::duration<double>(now - start_).count());
      for (std::size_t k = 0; k < before_.seconds.size(); ++k)
        run_.phases.seconds[k] += w.phases.seconds[k] - before_.seconds[k];
    }
    before_ = w.phases;
    start_ = now;
    return run_.seconds.size() == blocks_.repeat;
  }

private:
  const ScalingBlocks& blocks_;
  ScalingRun& run_;
  Clock::time_point start_{};
  Phases before_;
};

LoadTest compression() {
  LoadTest test;
  test.platen_speed = scaling_speed;
  test.stop_after_peak = 0.0;
  test.frames = 0;
  return test;
}

/// True for runs that are compared with each other: same study and way, and in strong scaling
/// the same specimen.
bool same_series(const ScalingPoint& a, const ScalingPoint& b) {
  return a.study == b.study && a.way() == b.way() &&
         (a.study == ScalingStudy::weak || a.spheres == b.spheres);
}

/// What the ranks share, and how evenly.
void measure_parts(const World& w, ScalingRun& run) {
  std::size_t rows = 0, bonds = 0;
  for (const Neighbour& n : w.partition.neighbours) rows += n.receive.size();
  for (std::size_t k = 0; k < w.bonds.padded; ++k) bonds += w.bonds.stiffness[k] > 0.0;
  double most[] = {static_cast<double>(rows), static_cast<double>(bonds)};
  all_reduce_max(w.partition.ranks, most);
  double all = 0.0;
  for (const std::size_t one : sizes_of_all(w.partition.ranks, bonds)) all += static_cast<double>(one);
  run.halo_rows = static_cast<std::size_t>(most[0]);
  run.imbalance = most[1] * w.partition.ranks.count / all - 1.0;
}

}  // namespace

double ScalingRun::all_seconds() const { return std::accumulate(seconds.begin(), seconds.end(), 0.0); }

ScalingSpecimen make_scaling_specimen(std::size_t spheres, const Material& material, int threads) {
  PackRequest request;
  request.spheres = spheres;
  ScalingSpecimen s;
  s.assembly = assemble(pack_spheres(scaling_body, request), scaling_body, {}, Features{}, threads);
  AreaFactorRequest factor;
  factor.rule = AlphaRule::affine;
  factor.material = material;
  s.factor = find_area_factor(s.assembly, factor, threads);
  return s;
}

ScalingRun measure_scaling(const ScalingSpecimen& specimen, const Material& material,
                           const ScalingPoint& point, const ScalingBlocks& blocks,
                           const ScalingProgress& progress, const Ranks& ranks) {
  // ranges alone do not bind: TBB would spread them over all its threads, each with caches of its
  // own
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(point.threads));
  reset_peak_memory();
  WorldOptions options;
  options.scatter = point.scatter;
  options.precision = point.precision;
  options.threads = point.threads;
  World w = make_world(specimen.assembly, material, specimen.factor, options);
  ScalingRun run;
  run.point = point;
  run.steps = blocks.steps;
  run.ranks = ranks.count;
  run.bonds = w.bonds.size;
  if (!ranks.alone()) {
    w = distribute(std::move(w), ranks);
    measure_parts(w, run);
  }
  BlockClock clock(blocks, run);
  LoadHooks load;
  load.interrupted = [&] { return clock.tick(w); };
  if (progress)
    load.progress = [&](int, double, const CurveRow& row) {
      progress(w, static_cast<double>(w.step) / static_cast<double>(blocks.all_steps()), row);
    };
  LoadResult result;
  result.record.steps_per_row = ScalingBlocks::steps_per_row;
  // never so many rows that pairs of them are merged: blocks would no longer be whole rows
  result.record.capacity = blocks.all_steps() / ScalingBlocks::steps_per_row + 2;
  run_load_test(w, specimen.assembly, compression(), load, result);

  const BrokenCount broken = count_broken(w);
  run.broken = broken.tension + broken.shear;
  run.alpha = w.alpha;
  run.time_step = w.dt;
  run.table_bytes =
      column_bytes(w.particles) + column_bytes(w.bonds) + column_bytes(w.contacts) + store_bytes(w.single);
  run.peak_bytes = peak_memory();
  const World& whole = gather_to_root(w);
  run.state_hash = state_hash(whole.particles, whole.bonds);
  return run;
}

MedianAndRange step_time(const ScalingRun& run) {
  std::vector<double> of_a_step = run.seconds;
  for (double& seconds : of_a_step) seconds /= static_cast<double>(run.steps);
  return median_and_range_of(std::move(of_a_step));
}

double bond_updates(const ScalingRun& run) { return static_cast<double>(run.bonds) / step_time(run).median; }

double table_bytes_per_bond(const ScalingRun& run) {
  return static_cast<double>(run.table_bytes) / static_cast<double>(run.bonds);
}

ScalingGain gain_of(const ScalingRun& run, const std::vector<ScalingRun>& runs) {
  const ScalingRun* base = &run;
  for (const ScalingRun& other : runs)
    if (same_series(run.point, other.point) && other.point.threads < base->point.threads) base = &other;
  const double speed_up = bond_updates(run) / bond_updates(*base);
  return {speed_up, speed_up * base->point.threads / run.point.threads};
}

}  // namespace breccia
