// The moment of one intact bond of cement, and whether it breaks the bond. docs/model.md, "Parallel
// bond".
#pragma once
#include "kernels/laws/pair_kinematics.hpp"
#include "kernels/laws/parallel_bond.hpp"

namespace breccia {

/// N m, on lo, as it bends and twists.
struct Moment {
  Vec3 bending;         ///< across the normal
  double twisting = 0;  ///< about it
};

/// Parts of a couple, given the normal that it belongs to.
inline Moment moment_of(const Vec3& couple, const Vec3& normal) {
  const double along = dot(couple, normal);
  return {couple - along * normal, along};
}

/// (B123): the couple turns with the pair and grows with the spin of hi against lo.
inline Vec3 moment_after(const Vec3& couple, const Pair<double>& pair, const Vec3& spin_lo,
                         const Vec3& spin_hi, const MomentStiffness& k, double dt) {
  const Moment before = moment_of(couple, pair.normal_before);
  const Vec3 turn = dt * (spin_hi - spin_lo);
  const double about = dot(turn, pair.normal);
  return rotate_with_pair<true>(before.bending, pair) + k.bend * (turn - about * pair.normal) +
         (before.twisting + k.twist * about) * pair.normal;
}

/// J, stored by a moment. (B123)
inline double moment_energy(const Moment& m, const MomentStiffness& k) {
  return (k.bend > 0.0 ? 0.5 * dot(m.bending, m.bending) / k.bend : 0.0) +
         (k.twist > 0.0 ? 0.5 * m.twisting * m.twisting / k.twist : 0.0);
}

/// (B124): what the largest stresses in the cement do.
enum class CementState : unsigned char { holds, torn, sheared };

/// @param pull   N, of the spring, tension positive
/// @param shear  N
inline CementState cement_state(const ParallelBondLaw& law, const BondLimits<double>& limits, double pull,
                                double shear, const Moment& m, double area, bool plane) {
  const MomentForces more =
      forces_of_moments(norm(m.bending), std::abs(m.twisting), area, plane, law.moment_factor);
  if (pull + more.pull > limits.tension) return CementState::torn;
  const double strength = limits.cohesion + law.failure.friction_pressed * larger(0.0, -pull);
  return shear + more.shear > strength ? CementState::sheared : CementState::holds;
}

}  // namespace breccia
