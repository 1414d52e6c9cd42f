// Central differences with velocities at half steps and non-viscous global damping. MODEL sections 1 and 7;
// Onate et al. 2015, eqs. 5-10, 39, 40.
#pragma once
#include <cstddef>
#include <span>

#include "kernels/vec3.hpp"

namespace breccia {

/// Fractions of the force (torque) that always oppose the velocity (spin).
struct GlobalDamping {
  double translation = 0, rotation = 0;
};

/// F - alpha |F| v/|v|; F where v is zero.
inline Vec3 damped(const Vec3& force, const Vec3& velocity, double alpha) {
  const double speed2 = dot(velocity, velocity);
  if (!(speed2 > 0.0)) return force;
  return force - (alpha * std::sqrt(dot(force, force) / speed2)) * velocity;
}

struct Motion {
  std::span<Vec3> position, velocity, spin;  ///< spin is empty where nothing spins
  std::span<Vec3> force, torque;             ///< read, then zeroed for the next step
  std::span<const double> mass, radius;
};

/// Kick and drift of rows [first, last) that move freely.
void integrate_free(const Motion& m, std::size_t first, std::size_t last, double dt,
                    const GlobalDamping& damping);

/// Rows of a platen: z moves with `platen_velocity`; x and y are fixed (rough) or free (smooth); spins are
/// free.
void integrate_held(const Motion& m, std::size_t first, std::size_t last, double dt,
                    const GlobalDamping& damping, double platen_velocity, bool rough);

/// Moment of inertia of a solid sphere, kg m^2.
inline double sphere_inertia(double mass, double radius) { return 0.4 * mass * radius * radius; }

}  // namespace breccia
