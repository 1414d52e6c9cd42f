// The stability study: every scene, each of its parts, at fractions of its exact limit.
#pragma once
#include <vector>

#include "core/studies/stability/run.hpp"

namespace breccia {

/// Fractions of the limit. A law's limit is asked for, not sharp: with global damping 1/(1 + alpha)
/// is a margin, the held layers are taken as free, and damage lowers the stiffness; what is 1.5
/// times beyond it has to be stopped all the same.
inline const std::vector<double>& fractions_of(StabilityPart part) {
  static const std::vector<double> sharp{0.5, 0.8, 0.99, 1.02, 1.1}, asked{0.5, 0.8, 0.99, 1.5};
  return part == StabilityPart::law ? asked : sharp;
}

/// All fractions of one part of a scene. A scene that is refused has one run, of fraction 0.
std::vector<StabilityRun> study_stability(const StabilityScene& scene, StabilityPart part,
                                          const Material& material, const StabilityLength& length);

/// True for what the study exists to find: a network that blew up within its limit, did not beyond
/// it, or did so unnoticed.
bool is_amiss(const StabilityRun& run);

}  // namespace breccia
