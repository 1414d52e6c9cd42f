// How near a stress tensor is to failure, by criteria that see all directions: Rankine,
// Mohr-Coulomb, Drucker-Prager. docs/model.md, "Stress". For pictures: no bond breaks by them.
#pragma once
#include <array>

#include "core/fields/stress.hpp"

namespace breccia {

/// What the criteria compare with. Pa.
struct TensorStrengths {
  double tension = 0, cohesion = 0;
  double friction = 0;  ///< tan of the angle
};

/// Pa, largest first; tension positive.
std::array<double, 3> principal_stresses(const Stress& stress);

/// 1 where the criterion is met, 0 where nothing tends towards it. (B122)
double rankine_state(const std::array<double, 3>& principal, const TensorStrengths& strengths);
double mohr_coulomb_state(const std::array<double, 3>& principal, const TensorStrengths& strengths);
/// The cone that meets Mohr-Coulomb's pyramid in compression.
double drucker_prager_state(const std::array<double, 3>& principal, const TensorStrengths& strengths);

}  // namespace breccia
