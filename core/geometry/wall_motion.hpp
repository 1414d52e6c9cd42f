// Walls that move as it is prescribed: a rigid body's motion between two times. (B39)
#pragma once
#include <limits>

#include "kernels/math/wall.hpp"

namespace breccia {

/// A constant velocity and a constant spin about a centre that travels along.
struct WallMotion {
  Vec3 velocity;                                          ///< m/s
  Vec3 spin;                                              ///< rad/s
  Vec3 centre;                                            ///< m, at time 0
  double start = 0;                                       ///< s; at rest before
  double stop = std::numeric_limits<double>::infinity();  ///< s; at rest after

  bool operator==(const WallMotion&) const = default;
  bool moves() const { return dot(velocity, velocity) > 0.0 || dot(spin, spin) > 0.0; }
};

/// The wall where it is at a time, s, given where it is at time 0.
Wall placed(const Wall& wall, const WallMotion& motion, double time);

/// m, the centre at a time.
Vec3 centre_at(const WallMotion& motion, double time);

/// m/s, of the point of the moving body that is at `place`.
Vec3 velocity_at(const WallMotion& motion, double time, const Vec3& place);
/// rad/s
Vec3 spin_at(const WallMotion& motion, double time);

/// m/s, that no point of the surface within `reach` of the centre exceeds on its way through space:
/// none where the motion carries the surface onto itself, as a drum's.
double surface_speed(const Wall& wall, const WallMotion& motion, double reach);

}  // namespace breccia
