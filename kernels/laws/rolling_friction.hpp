// Resistance of a contact to rolling, limited by mu_r R* F_n: models A (constant torque) and C
// (elastic-plastic, without its viscous part) of Ai, Chen, Rotter and Ooi, Powder Technol. 206
// (2011).
#pragma once
#include "kernels/math/lanes.hpp"

namespace breccia {

/// The part of a relative spin that rolls: without the twist about the normal.
inline Vec3 rolling_spin(const Vec3& spin_lo, const Vec3& spin_hi, const Vec3& normal) {
  const Vec3 relative = spin_lo - spin_hi;
  return relative - dot(relative, normal) * normal;
}

/// (B38): torque on lo, N m: of constant size against the rolling, but never more than stops it
/// within the step.
/// @param limit    N m, mu_r R* F_n
/// @param inertia  kg m^2, reduced moment of inertia of the two ends
inline Vec3 constant_rolling_torque(const Vec3& rolling, double limit, double inertia, double dt) {
  const double rate = norm(rolling);
  if (!(rate > 0.0)) return {};
  return (-smaller(limit, inertia * rate / dt) / rate) * rolling;
}

/// Torque on lo, N m: a spring against rolling that slips at a limit.
/// @param torque  N m, of the step before
/// @param spring  N m per rad
inline Vec3 slipping_rolling_torque(const Vec3& torque, const Vec3& rolling, double spring, double limit,
                                    double dt) {
  const Vec3 next = torque - (spring * dt) * rolling;
  const double size = norm(next);
  return size > limit ? (limit / size) * next : next;
}

/// (B38): torque on lo, N m: a spring of stiffness 2.25 k_n (mu_r R*)^2 that yields at the limit.
/// @param torque     N m, of the step before
/// @param stiffness  N/m, k_n at the present overlap
/// @param lever      m, mu_r R*
/// @param force      N, normal, positive
inline Vec3 elastic_plastic_rolling_torque(const Vec3& torque, const Vec3& rolling, double stiffness,
                                           double lever, double force, double dt) {
  return slipping_rolling_torque(torque, rolling, 2.25 * stiffness * lever * lever, lever * force, dt);
}

}  // namespace breccia
