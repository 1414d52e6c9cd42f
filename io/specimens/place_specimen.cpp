// A specimen put in place, and the checks that need it there.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "core/base/error.hpp"
#include "io/specimens/read_specimen.hpp"
#include "io/text/units.hpp"

namespace breccia {
namespace {

Vec3 turned(const Vec3& p, char axis) {
  if (axis == 'y') return {p.z, p.x, p.y};
  if (axis == 'x') return {p.y, p.z, p.x};
  return p;
}

double along(const Vec3& p, char axis) { return axis == 'x' ? p.x : axis == 'y' ? p.y : p.z; }

/// The coordinate across the axis, of the two, that varies less: the discs' own axis. y where neither varies.
char flat_coordinate(const Specimen& specimen, char axis) {
  const auto spread = [&](char of) {
    const auto [low, high] = std::minmax_element(
        specimen.spheres.begin(), specimen.spheres.end(),
        [of](const auto& a, const auto& b) { return along(a.centre, of) < along(b.centre, of); });
    return along(high->centre, of) - along(low->centre, of);
  };
  const char first = axis == 'y' ? 'z' : 'y', second = axis == 'x' ? 'z' : 'x';
  return spread(first) <= spread(second) ? first : second;
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
double outside(const Vec3& p, const Body& body, Space space) {
  const double height = std::abs(p.z) - body.height / 2;
  if (space == Space::two_d)
    return body.shape == Shape::box ? std::max(height, std::abs(p.x) - body.diameter / 2)
                                    : std::hypot(p.x, p.z) - body.diameter / 2;
  const double across = body.shape == Shape::box
                            ? std::max(std::abs(p.x) - body.diameter / 2, std::abs(p.y) - body.depth / 2)
                            : std::hypot(p.x, p.y) - body.diameter / 2;
  return std::max(height, across);
}

std::string describe(const Body& body, Space space) {
  const auto length = [](double value) { return format_quantity(value, dimension::length); };
  if (space == Space::two_d)
    return body.shape == Shape::box
               ? fmt::format("rectangle {} x {}", length(body.diameter), length(body.height))
               : fmt::format("disc D {}", length(body.diameter));
  if (body.shape == Shape::box)
    return fmt::format("box {} x {} x {}", length(body.diameter), length(body.depth), length(body.height));
  return fmt::format("{} D {} x H {}", body.shape == Shape::disc ? "disc" : "cylinder", length(body.diameter),
                     length(body.height));
}

std::string millimetres(double metres) { return fmt::format("{:.4g} mm", 1e3 * metres); }

void check_inside(const Specimen& specimen, const Body& body, Space space) {
  const double allowed = 0.02 * body.diameter;
  const SpecimenSphere* worst = nullptr;
  std::size_t count = 0;
  double farthest = allowed;
  for (const SpecimenSphere& sphere : specimen.spheres) {
    const double distance = outside(sphere.centre, body, space);
    if (distance > allowed) ++count;
    if (distance > farthest) farthest = distance, worst = &sphere;
  }
  if (!worst) return;
  fail<BadInput>(
      "{}: the centre of sphere {} lies {} outside the {} ({} of {} spheres beyond the {} allowed); check "
      "specimen.diameter, height, axis and centre",
      place_of(specimen, *worst), worst->id, millimetres(farthest), describe(body, space), count,
      specimen.spheres.size(), millimetres(allowed));
}

/// Sets y to 0 where it is the same for all discs.
void put_in_plane(Specimen& specimen, char axis, char flat) {
  const SpecimenSphere& first = specimen.spheres.front();
  const auto off = [&](const SpecimenSphere& s) { return std::abs(s.centre.y - first.centre.y); };
  double size = first.radius;
  for (const SpecimenSphere& s : specimen.spheres)
    size = std::max({size, std::abs(s.centre.x - first.centre.x), std::abs(s.centre.z - first.centre.z)});
  const auto worst = std::max_element(specimen.spheres.begin(), specimen.spheres.end(),
                                      [&](const auto& a, const auto& b) { return off(a) < off(b); });
  if (off(*worst) > 1e-9 * size)
    fail<BadInput>(
        "{}: a 3-D mesh in a 2-D scene: along {} sphere {} lies {} from sphere {}; all discs have one {} "
        "when {} "
        "is the axis: leave out specimen.dimensions or check specimen.axis",
        place_of(specimen, *worst), flat, worst->id, millimetres(off(*worst)), first.id, flat, axis);
  for (SpecimenSphere& s : specimen.spheres) s.centre.y = 0;
}

}  // namespace

Specimen place_specimen(Specimen specimen, char axis, std::optional<Vec3> centre, Space space) {
  const Vec3 middle = centre ? *centre : middle_of_box(specimen.spheres);
  if (space == Space::two_d && !specimen.spheres.empty()) {
    const char flat = flat_coordinate(specimen, axis);
    const char width = static_cast<char>('x' + 'y' + 'z' - axis - flat);
    for (SpecimenSphere& sphere : specimen.spheres) {
      const Vec3 p = sphere.centre - middle;
      sphere.centre = {along(p, width), along(p, flat), along(p, axis)};
    }
    put_in_plane(specimen, axis, flat);
    return specimen;
  }
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

void check_specimen(const Specimen& specimen, const Body& body, Space space) {
  if (specimen.spheres.empty()) fail<BadInput>("{}: no sphere in the specimen", specimen.source);
  check_coincident(specimen);
  check_inside(specimen, body, space);
}

}  // namespace breccia
