// A specimen put in place, and the checks that need it there.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "core/error.hpp"
#include "io/read_specimen.hpp"
#include "io/units.hpp"

namespace breccia {
namespace {

Vec3 turned(const Vec3& p, char axis) {
  if (axis == 'y') return {p.z, p.x, p.y};
  if (axis == 'x') return {p.y, p.z, p.x};
  return p;
}

Vec3 middle_of_box(const std::vector<SpecimenSphere>& spheres) {
  constexpr double huge = std::numeric_limits<double>::max();
  Vec3 low{huge, huge, huge}, high{-huge, -huge, -huge};
  for (const SpecimenSphere& s : spheres) {
    low = {std::min(low.x, s.centre.x - s.radius), std::min(low.y, s.centre.y - s.radius),
           std::min(low.z, s.centre.z - s.radius)};
    high = {std::max(high.x, s.centre.x + s.radius), std::max(high.y, s.centre.y + s.radius),
            std::max(high.z, s.centre.z + s.radius)};
  }
  return 0.5 * (low + high);
}

std::string place_of(const Specimen& specimen, const SpecimenSphere& sphere) {
  return sphere.line > 0 ? fmt::format("{}:{}", specimen.source, sphere.line) : specimen.source;
}

void check_coincident(const Specimen& specimen) {
  const auto& spheres = specimen.spheres;
  std::vector<std::size_t> order(spheres.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) {
    const Vec3& p = spheres[i].centre;
    return std::make_tuple(p.x, p.y, p.z);
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  const auto twin =
      std::adjacent_find(order.begin(), order.end(), [&](auto a, auto b) { return key(a) == key(b); });
  if (twin == order.end()) return;
  const SpecimenSphere &first = spheres[twin[0]], &second = spheres[twin[1]];
  const std::string line = first.line > 0 ? fmt::format(" (line {})", first.line) : "";
  fail<BadInput>("{}: sphere {} has the centre of sphere {}{}; remove one of them",
                 place_of(specimen, second), second.id, first.id, line);
}

/// How far a centre lies outside the body; negative inside.
double outside(const Vec3& p, const Body& body) {
  const double along = std::abs(p.z) - body.height / 2;
  const double across = body.shape == Shape::box
                            ? std::max(std::abs(p.x) - body.diameter / 2, std::abs(p.y) - body.depth / 2)
                            : std::hypot(p.x, p.y) - body.diameter / 2;
  return std::max(along, across);
}

std::string describe(const Body& body) {
  const auto length = [](double value) { return format_quantity(value, dimension::length); };
  if (body.shape == Shape::box)
    return fmt::format("box {} x {} x {}", length(body.diameter), length(body.depth), length(body.height));
  return fmt::format("{} D {} x H {}", body.shape == Shape::disc ? "disc" : "cylinder", length(body.diameter),
                     length(body.height));
}

std::string millimetres(double metres) { return fmt::format("{:.4g} mm", 1e3 * metres); }

void check_inside(const Specimen& specimen, const Body& body) {
  const double allowed = 0.02 * body.diameter;
  const SpecimenSphere* worst = nullptr;
  std::size_t count = 0;
  double farthest = allowed;
  for (const SpecimenSphere& sphere : specimen.spheres) {
    const double distance = outside(sphere.centre, body);
    if (distance > allowed) ++count;
    if (distance > farthest) farthest = distance, worst = &sphere;
  }
  if (!worst) return;
  fail<BadInput>(
      "{}: the centre of sphere {} lies {} outside the {} ({} of {} spheres beyond the {} allowed); check "
      "specimen.diameter, height, axis and centre",
      place_of(specimen, *worst), worst->id, millimetres(farthest), describe(body), count,
      specimen.spheres.size(), millimetres(allowed));
}

}  // namespace

Specimen place_specimen(Specimen specimen, char axis, std::optional<Vec3> centre) {
  const Vec3 middle = centre ? *centre : middle_of_box(specimen.spheres);
  for (SpecimenSphere& sphere : specimen.spheres) sphere.centre = turned(sphere.centre - middle, axis);
  return specimen;
}

Specimen stand_disc(Specimen specimen, char axis, std::optional<char> load_axis) {
  const char load = load_axis.value_or(axis == 'z' ? 'y' : 'z');
  // the file's axes x, y, z lie after place_specimen along: axis z: x, y, z; axis y: y, z, x; axis x: z, x, y
  const bool along_x = axis == 'z' ? load == 'x' : axis == 'y' ? load == 'z' : load == 'y';
  for (SpecimenSphere& s : specimen.spheres) {
    const Vec3 c = s.centre;
    s.centre = along_x ? Vec3{c.y, c.z, c.x} : Vec3{c.x, -c.z, c.y};
  }
  return specimen;
}

void check_specimen(const Specimen& specimen, const Body& body) {
  if (specimen.spheres.empty()) fail<BadInput>("{}: no sphere in the specimen", specimen.source);
  check_coincident(specimen);
  check_inside(specimen, body);
}

}  // namespace breccia
