#include "core/geometry/body_walls.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"

namespace breccia {
namespace {

using std::numbers::pi;

constexpr int sides = 360;

bool is_round(const Body& body) { return body.shape != Shape::box; }

void check(const Body& body, Space space, char axis) {
  const bool has_depth = is_round(body) || space == Space::two_d || body.depth > 0.0;
  if (!(body.diameter > 0.0) || !(body.height > 0.0) || !has_depth)
    fail<BadInput>(
        "specimen: a body of diameter {} m, height {} m and depth {} m has no volume; check "
        "specimen.diameter, "
        "height and depth",
        body.diameter, body.height, body.depth);
  if (axis != 'z' && !(axis == 'y' && is_round(body)))
    fail<BadInput>("specimen: cells of a body with its axis along {}: only z, or y for a cylinder or disc",
                   axis);
}

/// A wall at `distance`, or as far out as the farthest centre.
void add_wall(BodyWalls& walls, const Vec3& normal, double distance, bool lateral,
              std::span<const Vec3> centres) {
  double farthest = distance;
  for (const Vec3& x : centres) farthest = std::max(farthest, dot(normal, x));
  walls.grown = std::max(walls.grown, farthest - distance);
  walls.planes.push_back({normal, farthest, lateral});
}

void add_round_lateral(BodyWalls& walls, double nominal, char axis, std::span<const Vec3> centres) {
  const auto across = [axis](const Vec3& x) { return axis == 'z' ? x.y : x.z; };
  double radius = nominal;
  for (const Vec3& x : centres) radius = std::max(radius, std::hypot(x.x, across(x)));
  walls.grown = std::max(walls.grown, radius - nominal);
  // n a^2 tan(pi/n) = pi R^2: the prism has the section of the circle
  const double apothem = radius * std::sqrt(pi / (sides * std::tan(pi / sides)));
  for (int k = 0; k < sides; ++k) {
    const double angle = 2.0 * pi * (k + 0.5) / sides, c = std::cos(angle), s = std::sin(angle);
    walls.planes.push_back({axis == 'z' ? Vec3{c, s, 0.0} : Vec3{c, 0.0, s}, apothem, true});
  }
}

}  // namespace

BodyWalls walls_of(const Body& body, Space space, char axis, std::span<const Vec3> centres) {
  check(body, space, axis);
  BodyWalls walls;
  const bool lies = axis == 'y', flat = space == Space::two_d;
  // a standing cylinder cut by the x-z plane is a rectangle
  if (is_round(body) && (!flat || lies)) {
    add_round_lateral(walls, 0.5 * body.diameter, axis, centres);
  } else {
    for (const double s : {-1.0, 1.0}) add_wall(walls, {s, 0.0, 0.0}, 0.5 * body.diameter, true, centres);
    if (!flat)
      for (const double s : {-1.0, 1.0}) add_wall(walls, {0.0, s, 0.0}, 0.5 * body.depth, true, centres);
  }
  if (flat && lies) return walls;
  for (const double s : {-1.0, 1.0})
    add_wall(walls, lies ? Vec3{0.0, s, 0.0} : Vec3{0.0, 0.0, s}, 0.5 * body.height, false, centres);
  return walls;
}

double lateral_of(const Body& body, Space space, char axis) {
  check(body, space, axis);
  if (space == Space::two_d) return is_round(body) && axis == 'y' ? pi * body.diameter : 2.0 * body.height;
  return body.height * (is_round(body) ? pi * body.diameter : 2.0 * (body.diameter + body.depth));
}

}  // namespace breccia
