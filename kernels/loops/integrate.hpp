// Central differences with velocities at half steps and non-viscous global damping: docs/model.md,
// "Particles" and "Global damping"; Onate et al. 2015, eqs. 5-10, 39, 40.
#pragma once
#include <cstddef>
#include <span>

#include "kernels/math/instruction_set.hpp"
#include "kernels/math/strided.hpp"
#include "kernels/math/vec3.hpp"

namespace breccia {

/// What opposes every velocity and spin: fractions of the force and of the torque (P39) (P40), or,
/// viscous, rates in 1/s of the momentum (B113).
struct GlobalDamping {
  double translation = 0, rotation = 0;
  bool viscous = false;
};

/// The brake on a velocity (or spin): the force (torque) that opposes it, over it.
/// @param part     fraction of the force, or rate in 1/s where viscous
/// @param inertia  kg, kg m^2
inline double brake_on(const Vec3& velocity, const Vec3& force, double part, bool viscous, double inertia) {
  if (viscous) return part * inertia;  // (B113)
  const double speed2 = dot(velocity, velocity);
  return speed2 > 0.0 ? part * std::sqrt(dot(force, force) / speed2) : 0.0;  // (P39) (P40)
}

struct Motion {
  Strided<Vec3> position, velocity, spin;  ///< spin is empty where nothing spins
  Strided<Vec3> force, torque;             ///< read, then zeroed for the next step
  std::span<const double> mass, radius;
  double inertia_factor = 0.4;               ///< I = factor m r^2
  bool spins = true;                         ///< false: the scene has no rotation, spins stay zero
  std::span<const Vec3> gauge_weights = {};  ///< 1/m, by row; empty: nobody reads gauges
};

/// J, of kicks: kinetic energy between the velocities before and after them, and what global
/// damping takes over the half steps before and after (B48) (B56).
struct MotionWork {
  double kinetic = 0, motion_this = 0, motion_next = 0, spin_this = 0, spin_next = 0;
};

/// What comes of moving rows.
struct Integrated : MotionWork {  ///< zeros where nothing is booked
  Vec3 gauge;                     ///< 1, sum of gauge weights times new positions, by component
  unsigned events = 0;            ///< of single precision: SingleEvent bits
};

/// Kick and drift of rows [first, last) that move freely.
/// @param booked  whether to work out what the kicks did
using IntegrateFree = Integrated (*)(const Motion& m, std::size_t first, std::size_t last, double dt,
                                     const GlobalDamping& damping, bool booked);
IntegrateFree integrate_free_for(InstructionSet set);

/// Motion that a body's rows share: z is prescribed; x and y too, unless they are free. (B64)
struct HeldMotion {
  Vec3 velocity;              ///< m/s
  bool lateral_free = false;  ///< x and y follow the forces
};

/// Rows of a platen or a shear box; spins are free.
void integrate_held(const Motion& m, std::size_t first, std::size_t last, double dt,
                    const GlobalDamping& damping, const HeldMotion& held);

/// I = factor m r^2: of a sphere or a disc. (B2)
inline constexpr double sphere_inertia_factor = 0.4, disc_inertia_factor = 0.5;

/// Moment of inertia, kg m^2.
inline double inertia(double factor, double mass, double radius) { return factor * mass * radius * radius; }

}  // namespace breccia
