// The body a packing fills: its volume, its walls, a point in it.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/specimen.hpp"
#include "kernels/vec3.hpp"

namespace breccia::packing {

/// Edges of the box around the body, m.
inline Vec3 extent(const Body& body) {
  return {body.diameter, body.shape == Shape::box ? body.depth : body.diameter, body.height};
}

/// m^3
inline double volume(const Body& body) {
  const Vec3 edge = extent(body);
  return (body.shape == Shape::box ? 1.0 : std::numbers::pi / 4) * edge.x * edge.y * edge.z;
}

/// Calls f(distance to the wall, normal into the body) for both ends and the mantle (box: its four sides).
template <class F>
void for_each_wall(const Body& body, const Vec3& x, F&& f) {
  f(body.height / 2 - x.z, Vec3{0, 0, -1});
  f(body.height / 2 + x.z, Vec3{0, 0, 1});
  if (body.shape == Shape::box) {
    f(body.diameter / 2 - x.x, Vec3{-1, 0, 0});
    f(body.diameter / 2 + x.x, Vec3{1, 0, 0});
    f(body.depth / 2 - x.y, Vec3{0, -1, 0});
    f(body.depth / 2 + x.y, Vec3{0, 1, 0});
  } else if (const double rho = std::hypot(x.x, x.y); rho > 0) {
    f(body.diameter / 2 - rho, Vec3{-x.x / rho, -x.y / rho, 0});
  }
}

/// The point of the body at least `margin` from every wall that is nearest to x.
inline Vec3 keep_inside(const Body& body, Vec3 x, double margin) {
  const auto within = [margin](double c, double edge) {
    return std::clamp(c, margin - edge / 2, edge / 2 - margin);
  };
  x.z = within(x.z, body.height);
  if (body.shape == Shape::box) return {within(x.x, body.diameter), within(x.y, body.depth), x.z};
  const double rho = std::hypot(x.x, x.y), most = body.diameter / 2 - margin;
  if (rho > most) x.x *= most / rho, x.y *= most / rho;
  return x;
}

/// Maps the unit cube onto the body less `margin` at every wall, equal volumes to equal volumes.
inline Vec3 place(const Body& body, const Vec3& u, double margin) {
  const Vec3 edge = extent(body) - Vec3{2 * margin, 2 * margin, 2 * margin};
  const double z = (u.z - 0.5) * edge.z;
  if (body.shape == Shape::box) return {(u.x - 0.5) * edge.x, (u.y - 0.5) * edge.y, z};
  const double rho = edge.x / 2 * std::sqrt(u.x), angle = 2 * std::numbers::pi * u.y;
  return {rho * std::cos(angle), rho * std::sin(angle), z};
}

}  // namespace breccia::packing
