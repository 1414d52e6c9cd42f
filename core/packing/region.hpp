// The region a packing fills: its volume, its walls, a point in it.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/scene_options.hpp"
#include "core/geometry/specimen.hpp"
#include "kernels/math/vec3.hpp"

namespace breccia::packing {

/// A body and the space it lies in. In the plane, y = 0, a box is the rectangle of its width along
/// x and its height along z, a disc the circle of its diameter about y; both are 1 m thick.
struct Region {
  Body body;
  Space space = Space::three_d;
  Region(const Body& of, Space in = Space::three_d) : body(of), space(in) {}

  bool plane() const { return space == Space::two_d; }
  bool box() const { return body.shape == Shape::box; }
};

/// Edges of the box around the body, m; 1 m along y in the plane.
inline Vec3 extent(const Region& region) {
  const Body& body = region.body;
  if (region.plane()) return {body.diameter, 1, region.box() ? body.height : body.diameter};
  return {body.diameter, region.box() ? body.depth : body.diameter, body.height};
}

/// m^3
inline double volume(const Region& region) {
  const Vec3 edge = extent(region);
  return (region.box() ? 1.0 : std::numbers::pi / 4) * edge.x * edge.y * edge.z;
}

/// Of a sphere, or of a disc 1 m thick, m^3.
inline double volume_of(double radius, Space space) {
  return space == Space::two_d ? std::numbers::pi * radius * radius
                               : 4 * std::numbers::pi / 3 * radius * radius * radius;
}

/// Edge of the cube, in the plane of the square, that each of `particles` has for itself, m.
inline double spacing(const Region& region, std::size_t particles) {
  const double share = volume(region) / static_cast<double>(particles);
  return region.plane() ? std::sqrt(share) : std::cbrt(share);
}

/// 1 - sum of the particles' volumes/the body's: overlaps count twice.
inline double porosity(const Region& region, const Specimen& specimen) {
  double filled = 0;
  for (const SpecimenSphere& s : specimen.spheres) filled += volume_of(s.radius, region.space);
  return 1 - filled / volume(region);
}

/// Calls f(distance to the wall, normal into the body) for both ends and the lateral surface (box:
/// its four sides; in the plane: two ends and two sides, or the one round wall).
template <class F>
void for_each_wall(const Region& region, const Vec3& x, F&& f) {
  const Body& body = region.body;
  if (region.plane() && !region.box()) {
    if (const double rho = std::hypot(x.x, x.z); rho > 0)
      f(body.diameter / 2 - rho, Vec3{-x.x / rho, 0, -x.z / rho});
    return;
  }
  f(body.height / 2 - x.z, Vec3{0, 0, -1});
  f(body.height / 2 + x.z, Vec3{0, 0, 1});
  if (region.box()) {
    f(body.diameter / 2 - x.x, Vec3{-1, 0, 0});
    f(body.diameter / 2 + x.x, Vec3{1, 0, 0});
    if (region.plane()) return;
    f(body.depth / 2 - x.y, Vec3{0, -1, 0});
    f(body.depth / 2 + x.y, Vec3{0, 1, 0});
  } else if (const double rho = std::hypot(x.x, x.y); rho > 0) {
    f(body.diameter / 2 - rho, Vec3{-x.x / rho, -x.y / rho, 0});
  }
}

/// The point of the body at least `margin` from every wall that is nearest to x.
inline Vec3 keep_inside(const Region& region, Vec3 x, double margin) {
  const Body& body = region.body;
  const auto within = [margin](double c, double edge) {
    return std::clamp(c, margin - edge / 2, edge / 2 - margin);
  };
  const auto round = [&](double& a, double& b) {
    const double rho = std::hypot(a, b), most = body.diameter / 2 - margin;
    if (rho > most) a *= most / rho, b *= most / rho;
  };
  if (region.plane()) {
    x.y = 0;
    if (region.box()) return {within(x.x, body.diameter), 0, within(x.z, body.height)};
    round(x.x, x.z);
    return x;
  }
  x.z = within(x.z, body.height);
  if (region.box()) return {within(x.x, body.diameter), within(x.y, body.depth), x.z};
  round(x.x, x.y);
  return x;
}

/// Maps the unit cube onto the body less `margin` at every wall, equal volumes to equal volumes. In
/// the plane x and y of the unit cube count.
inline Vec3 place(const Region& region, const Vec3& u, double margin) {
  const Vec3 edge = extent(region) - Vec3{2 * margin, 2 * margin, 2 * margin};
  const double rho = edge.x / 2 * std::sqrt(u.x), angle = 2 * std::numbers::pi * u.y;
  if (region.plane()) {
    if (region.box()) return {(u.x - 0.5) * edge.x, 0, (u.y - 0.5) * edge.z};
    return {rho * std::cos(angle), 0, rho * std::sin(angle)};
  }
  const double z = (u.z - 0.5) * edge.z;
  if (region.box()) return {(u.x - 0.5) * edge.x, (u.y - 0.5) * edge.y, z};
  return {rho * std::cos(angle), rho * std::sin(angle), z};
}

}  // namespace breccia::packing
