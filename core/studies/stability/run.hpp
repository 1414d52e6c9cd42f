// One run of the stability study: a scene, a part of it, a fraction of the limit.
#pragma once
#include <limits>
#include <string>

#include "core/studies/stability/scene.hpp"

namespace breccia {

/// stable: ran to its end, and energy stayed bounded. blew_up: a guard stopped it, and without
/// checks its energy leaves all bounds. stopped: a guard stopped it, and it would not have left all
/// bounds, or is a law's run. refused: it was never begun. unnoticed: left all bounds and was not
/// stopped, or a law's run beyond the limit whose peak is not that of small steps.
enum class Verdict { stable, blew_up, stopped, refused, unnoticed };
inline constexpr std::string_view name_of(Verdict verdict) {
  constexpr std::string_view names[] = {"stable", "blew up", "stopped", "refused", "unnoticed"};
  return names[static_cast<int>(verdict)];
}

/// What a scene comes to, before any step.
struct StabilityWorld {
  World world;
  Assembly assembly;
  LoadTest load;
  double blast = 0;
  std::uint64_t rest_steps = 0;
  double exact = 0;  ///< s, see exact_time_step
};

/// What is measured of one run; NaN where a scene has no such number.
struct StabilityRun {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::string_view scene, stresses;
  StabilityPart part = StabilityPart::network;
  double fraction = 0;  ///< of the exact limit
  std::size_t spheres = 0, bonds = 0;
  double exact_dt = none;     ///< s, the limit
  double estimate_dt = none;  ///< s, critical_time_step
  double dt = none;           ///< s
  Verdict verdict = Verdict::stable;
  std::string cause;           ///< of a refusal or stop
  std::uint64_t steps = 0;     ///< done
  double energy_error = none;  ///< of a network without loss the largest departure of the energy from its
                               ///< start, over it; of a test that of the ledger
  double drift = none;   ///< mean of the last tenth less the start, over it: of the energy; of a rest, stress
  double broken = none;  ///< bonds, of a test
  double peak = none;    ///< Pa, of a test
  double peak_change = none;  ///< of a test, from that of the smallest step
};

struct StabilityLength {
  std::uint64_t network_steps = 100'000;  ///< at the fraction that is nearest below 1; a fifth at the others
  double strain = 1.0;                    ///< of the scene's own stop strain
  double rest = 1.0;                      ///< of the scene's own steps of rest
  Precision precision = Precision::single;
};

/// @throws BadInput where the scene is refused
StabilityWorld make_stability_world(const StabilityScene& scene, StabilityPart part, const Material& material,
                                    Precision precision);

/// @param made  at rest; run at `fraction` of its limit for `steps` (a network) or its own loading
StabilityRun run_stability(const StabilityScene& scene, StabilityPart part, StabilityWorld made,
                           double fraction, std::uint64_t steps, const StabilityLength& length);

}  // namespace breccia
