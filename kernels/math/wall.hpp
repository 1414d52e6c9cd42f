// Walls that particles meet: planes, the insides of cylinders, triangles (B39). Each is known by
// its point nearest to a place; a sphere touches it where that point is nearer than its radius.
#pragma once
#include <algorithm>

#include "kernels/math/vec3.hpp"

namespace breccia {

enum class WallKind : unsigned char { plane, cylinder, triangle };

struct Wall {
  WallKind kind = WallKind::plane;
  Vec3 point;          ///< m, on the plane, on the cylinder's axis, or the triangle's first corner
  Vec3 direction;      ///< unit: the plane's normal, towards the particles, or the cylinder's axis
  double radius = 0;   ///< m, of the cylinder, which has no ends
  Vec3 second, third;  ///< m, other corners of the triangle
};

struct NearestPoint {
  Vec3 point;           ///< m
  bool on_rim = false;  ///< on an edge or corner of a triangle
};

/// Ericson, Real-Time Collision Detection (2005), section 5.1.5: by the region of the corner, edge
/// or face.
inline NearestPoint nearest_on_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0.0 && d2 <= 0.0) return {a, true};
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0.0 && d4 <= d3) return {b, true};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return {a + (d1 / (d1 - d3)) * ab, true};
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0.0 && d5 <= d6) return {c, true};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return {a + (d2 / (d2 - d6)) * ac, true};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 >= d3 && d5 >= d6) return {b + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b), true};
  const double share = 1.0 / (va + vb + vc);
  return {a + (vb * share) * ab + (vc * share) * ac, false};
}

/// The point of a wall nearest to `x`. On a cylinder's axis every point of a circle is: one of
/// them.
inline NearestPoint nearest_on_wall(const Wall& wall, const Vec3& x) {
  const Vec3 from = x - wall.point;
  const double along = dot(from, wall.direction);
  switch (wall.kind) {
    case WallKind::plane:
      return {x - along * wall.direction};
    case WallKind::cylinder: {
      Vec3 radial = from - along * wall.direction;
      if (!(dot(radial, radial) > 0.0)) {
        const bool steep = std::abs(wall.direction.x) < 0.9;
        radial = cross(wall.direction, steep ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
      }
      return {wall.point + along * wall.direction + (wall.radius / norm(radial)) * radial};
    }
    case WallKind::triangle:
      break;
  }
  return nearest_on_triangle(wall.point, wall.second, wall.third, x);
}

/// How far a place is from a wall on the side where particles may be, m: negative behind a plane or
/// outside a cylinder; a triangle has two good sides.
inline double clearance(const Wall& wall, const Vec3& x) {
  const Vec3 from = x - wall.point;
  const double along = dot(from, wall.direction);
  if (wall.kind == WallKind::plane) return along;
  if (wall.kind == WallKind::cylinder) return wall.radius - norm(from - along * wall.direction);
  return norm(nearest_on_wall(wall, x).point - x);
}

}  // namespace breccia
