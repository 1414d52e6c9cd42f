// The flat walls around a body.
#pragma once
#include <span>
#include <vector>

#include "core/base/scene_options.hpp"
#include "core/geometry/specimen.hpp"
#include "kernels/math/vec3.hpp"

namespace breccia {

struct WallPlane {
  Vec3 normal;      ///< unit, out of the body
  double distance;  ///< m, from the origin
  bool lateral;     ///< false: a flat end
};

struct BodyWalls {
  std::vector<WallPlane> planes;
  double grown = 0;  ///< m, largest move of a wall beyond its nominal place
};

/// Walls of a body around the origin, moved out where a centre lies outside. A round lateral
/// surface becomes a prism of 360 sides with the section of the circle. plane: those walls that
/// cross the x-z plane at right angles.
/// @param axis  'z', or 'y' for a cylinder or disc that lies
/// @throws BadInput: a size that is not above zero, an axis that is neither
BodyWalls walls_of(const Body& body, Space space, char axis, std::span<const Vec3> centres);

/// Nominal area of the lateral surface, m^2 (plane: its length times 1 m).
double lateral_of(const Body& body, Space space, char axis);

}  // namespace breccia
