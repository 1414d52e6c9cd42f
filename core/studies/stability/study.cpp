#include "core/studies/stability/study.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace breccia {
namespace {

/// Beyond the limit a law's peak within this of the peak of the smallest step counts as right: what
/// the step itself changes below the limit is as much.
constexpr double near_enough = 0.05;

/// A law's runs are held against that of the smallest step.
void compare_peaks(std::vector<StabilityRun>& runs) {
  const double wanted = runs.front().peak;
  for (StabilityRun& run : runs) {
    run.peak_change = run.peak / wanted - 1.0;
    if (run.verdict == Verdict::stable && run.fraction > 1.0 && std::abs(run.peak_change) > near_enough)
      run.verdict = Verdict::unnoticed;
  }
}

}  // namespace

std::vector<StabilityRun> study_stability(const StabilityScene& scene, StabilityPart part,
                                          const Material& material, const StabilityLength& length) {
  const std::vector<double>& fractions = fractions_of(part);
  std::vector<StabilityRun> runs(fractions.size());
  StabilityWorld made;
  try {
    made = make_stability_world(scene, part, material, length.precision);
  } catch (const BadInput& why) {
    StabilityRun refused;
    refused.scene = scene.name;
    refused.stresses = scene.stresses;
    refused.part = part;
    refused.verdict = Verdict::refused;
    refused.cause = why.what();
    return {refused};
  }
  const double nearest = fractions[2];  // below 1
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const std::uint64_t steps =
        fractions[k] == nearest ? length.network_steps : std::max<std::uint64_t>(length.network_steps / 5, 1);
    runs[k] = run_stability(scene, part, made, fractions[k], steps, length);
  }
  if (part == StabilityPart::law && made.blast == 0.0) compare_peaks(runs);
  return runs;
}

bool is_amiss(const StabilityRun& run) {
  if (run.part == StabilityPart::law) return false;
  const bool within = run.fraction < 1.0, blew_up = run.verdict == Verdict::blew_up;
  return run.verdict == Verdict::unnoticed || within == blew_up;
}

}  // namespace breccia
