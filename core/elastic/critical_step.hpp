// The largest step for which the central difference scheme is stable.
// docs/model.md, "Time step and mass scaling".
#pragma once
#include <span>

#include "core/elastic/dashpots.hpp"

namespace breccia {

/// What the particles can do.
struct Freedom {
  bool rotation = true;
  bool plane = false;           ///< two dimensions: no motion along y, no turn about x and z
  double inertia_factor = 0.4;  ///< I = factor m r^2
  bool cement = false;          ///< intact bonds pass moments
};

/// What bounds the step: masses, and all that may press between them.
struct StepScene {
  const ParticleTable& particles;
  const BondTable& bonds;        ///< each intact and pressed; a broken one unless it is open beyond `reach`
  const ContactTable& contacts;  ///< each pressed
  const Dashpots& dashpots;
  std::span<const double> shear_ratio;  ///< k_s/k_n: one, or by law
  double global_damping = 0;            ///< alpha, the larger of the two factors
  double reach = 0;                     ///< m, that particles may approach each other
  Freedom freedom;
  int threads = 1;
  std::span<const std::uint8_t> fixed = {};  ///< by row: held where they are; empty: none
};

/// What is known about a step. With K and C the stiffness and damping of bonds and contacts, the
/// scheme (damping forces from velocities half a step old) is stable if and only if lambda(dt), the
/// largest eigenvalue of M^-1 (dt^2 K/4 + dt C(dt)/2), is at most 1/(1 + alpha).
struct StepEstimate {
  /// lambda (1 + alpha): 1 is the limit. From below, short by more than 2 % with a probability
  /// under 1e-3
  double number = 0;
  double critical =
      0;  ///< s, where it would be 0.98, since it comes from below: a secant, good near the step in use
};

/// Looks at a step in use, and at what it should be instead. Costs some fifty applications of K.
/// @param enough  a number up to which the step is good as it is: `critical` is not worked out and
///                is the step
StepEstimate estimate_step(const StepScene& scene, double dt, double enough = 0.0);

/// No more than this times `dt`-fold can be added by the contacts given: a proven bound, by norms
/// (B44). The norm of one contact's part at either end is summed over the contacts of each
/// particle; no network exceeds the largest sum of two ends.
/// @param contacts  rows of scene.contacts
double stability_number_bound(const StepScene& scene, std::span<const std::size_t> contacts, double dt);

/// The step at which the stability number is 1, less 2 % for its error from below. Costs some sixty
/// applications of K.
/// @returns s; infinity where nothing is stiff
double critical_time_step(const StepScene& scene);

/// The same step converged to 1e-9, without the 2 %: what tests and studies hold against closed
/// forms.
/// @returns s
double exact_time_step(const StepScene& scene);

/// 2/sqrt of the largest eigenvalue of M^-1 K of each particle while its neighbours are fixed,
/// undamped. (P12) (P14)
/// @returns s, per particle; infinity for one that nothing touches
std::vector<double> own_time_steps(const StepScene& scene);

}  // namespace breccia
