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

/// The coordinate across the axis, of the two, that varies less: the discs' own axis. y where
/// neither varies.
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

struct Box {
  Vec3 low, high;
};

Box box_around(const Specimen& specimen, const std::vector<char>& of_body) {
  constexpr double huge = std::numeric_limits<double>::max();
  Vec3 low{huge, huge, huge}, high{-huge, -huge, -huge};
  for (std::size_t k = 0; k < specimen.spheres.size(); ++k) {
    if (!of_body.empty() && !of_body[k]) continue;
    const SpecimenSphere& s = specimen.spheres[k];
    low = {std::min(low.x, s.centre.x - s.radius), std::min(low.y, s.centre.y - s.radius),
           std::min(low.z, s.centre.z - s.radius)};
    high = {std::max(high.x, s.centre.x + s.radius), std::max(high.y, s.centre.y + s.radius),
            std::max(high.z, s.centre.z + s.radius)};
  }
  return {low, high};
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

/// Extent of the spheres over that of the nominal body, where it is the same in all directions.
std::optional<double> times_nominal(const Specimen& specimen, const Body& body, Space space) {
  const Box box = box_around(specimen, {});
  const Vec3 extent = box.high - box.low;
  const bool is_box = body.shape == Shape::box, plane = space == Space::two_d;
  const double height = plane && !is_box ? body.diameter : body.height;
  const double depth = is_box ? body.depth : body.diameter;
  const double x = extent.x / body.diameter, z = extent.z / height, y = plane ? x : extent.y / depth;
  const double mean = (x + y + z) / 3.0;
  const bool even = std::max({x, y, z}) < 1.2 * mean && std::min({x, y, z}) > 0.8 * mean;
  return even ? std::optional(mean) : std::nullopt;
}

/// Where the spheres are the nominal body but for one factor: which unit may have been taken for
/// which.
std::string unit_hint(const Specimen& specimen, const Body& body, Space space) {
  const std::optional<double> times = times_nominal(specimen, body, space);
  if (!times || (*times > 0.6 && *times < 1.7)) return "";
  struct Mistake {
    double factor;
    std::string_view what;
  };
  constexpr Mistake mistakes[] = {{1e6, "as if the file were in um"},
                                  {1e3, "as if the file were in mm"},
                                  {1e2, "as if the file were in cm"},
                                  {10, "as if cm had been taken for mm, or the file were in dm"},
                                  {1 / 0.0254, "as if the file were in inches"},
                                  {1 / 0.3048, "as if the file were in feet"},
                                  {25.4, "as if inches had been taken for mm"},
                                  {2.54, "as if inches had been taken for cm"},
                                  {2, "as if radii had been taken for diameters"},
                                  {0.5, "as if diameters had been taken for radii"},
                                  {1 / 2.54, "as if cm had been taken for inches"},
                                  {1 / 25.4, "as if mm had been taken for inches"},
                                  {0.1, "as if mm had been taken for cm"},
                                  {1e-2, "as if specimen.diameter and height were in cm"},
                                  {1e-3, "as if specimen.diameter and height were in mm"},
                                  {1e-6, "as if specimen.diameter and height were in um"}};
  const auto away = [&](const Mistake& m) { return std::abs(std::log(*times / m.factor)); };
  const Mistake& nearest_to =
      *std::min_element(std::begin(mistakes), std::end(mistakes),
                        [&](const Mistake& a, const Mistake& b) { return away(a) < away(b); });
  const bool known = away(nearest_to) < 0.2;
  return fmt::format("; the spheres fill {:.4g} times the nominal size in all directions{}{}",
                     known ? nearest_to.factor : *times, known ? ", " : "", known ? nearest_to.what : "");
}

void check_inside(const Specimen& specimen, const Body& body, Space space, const std::vector<char>& of_body) {
  const double allowed = 0.02 * body.diameter;
  const SpecimenSphere* worst = nullptr;
  std::size_t count = 0, strays = 0;
  double farthest = allowed;
  for (std::size_t k = 0; k < specimen.spheres.size(); ++k) {
    const SpecimenSphere& sphere = specimen.spheres[k];
    const double distance = outside(sphere.centre, body, space);
    if (distance > allowed) {
      ++count;
      strays += !of_body.empty() && of_body[k] == 0;
    }
    if (distance > farthest) farthest = distance, worst = &sphere;
  }
  if (!worst) return;
  if (strays == count)
    fail<BadInput>(
        "{}: sphere {} is a stray one: it hangs on nothing, {} outside the {} ({} such of {} spheres); "
        "remove it",
        place_of(specimen, *worst), worst->id, millimetres(farthest), describe(body, space), count,
        specimen.spheres.size());
  const Box box = box_around(specimen, of_body);
  const Vec3 extent = box.high - box.low;
  fail<BadInput>(
      "{}: the centre of sphere {} lies {} outside the {} ({} of {} spheres beyond the {} allowed); check "
      "specimen.diameter, height, axis and centre: along the axis the spheres fill {}, across it {}{}{}",
      place_of(specimen, *worst), worst->id, millimetres(farthest), describe(body, space), count,
      specimen.spheres.size(), millimetres(allowed), millimetres(extent.z), millimetres(extent.x),
      space == Space::two_d ? "" : " and " + millimetres(extent.y), unit_hint(specimen, body, space));
}

/// Radii in another unit than centres.
void check_fit_in(const Specimen& specimen, const Body& body, Space space) {
  const double smallest =
      std::min({body.diameter, body.shape == Shape::box && space != Space::two_d ? body.depth : body.diameter,
                space == Space::two_d && body.shape != Shape::box ? body.diameter : body.height});
  for (const SpecimenSphere& s : specimen.spheres)
    if (2.0 * s.radius > 1.3 * smallest)
      fail<BadInput>("{}: sphere {} has radius {}, too large for the {}; check the unit of its radius",
                     place_of(specimen, s), s.id, millimetres(s.radius), describe(body, space));
}

/// Spheres that fill a small part of the body in each direction.
void check_filled(const Specimen& specimen, const Body& body, Space space) {
  const Box box = box_around(specimen, {});
  const Vec3 extent = box.high - box.low;
  const double height = space == Space::two_d && body.shape != Shape::box ? body.diameter : body.height;
  if (extent.x < 0.5 * body.diameter && extent.z < 0.5 * height)
    fail<BadInput>(
        "{}: all spheres lie within {} x {}, in a {}; check specimen.diameter and height, and the unit "
        "of the file{}",
        specimen.source, millimetres(extent.x), millimetres(extent.z), describe(body, space),
        unit_hint(specimen, body, space));
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

Vec3 middle_of(const Specimen& specimen, const std::vector<char>& of_body) {
  const Box box = box_around(specimen, of_body);
  return 0.5 * (box.low + box.high);
}

Specimen place_specimen(Specimen specimen, char axis, std::optional<Vec3> centre, Space space,
                        const std::vector<char>& of_body) {
  const Vec3 middle = centre ? *centre : middle_of(specimen, of_body);
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

Vec3 way_in_file(const Specimen& as_read, const Vec3& way, char axis, Space space) {
  if (space != Space::two_d) return turned(way, axis == 'y' ? 'x' : axis == 'x' ? 'y' : 'z');
  const char flat = flat_coordinate(as_read, axis);
  const auto of = [&](char coordinate) {
    return coordinate == axis ? way.z : coordinate == flat ? 0.0 : way.x;
  };
  return {of('x'), of('y'), of('z')};
}

Specimen stand_disc(Specimen specimen, char axis, std::optional<char> load_axis) {
  const char load = load_axis.value_or(axis == 'z' ? 'y' : 'z');
  // the file's axes x, y, z lie after place_specimen along: axis z: x, y, z; axis y: y, z, x; axis
  // x: z, x, y
  const bool along_x = axis == 'z' ? load == 'x' : axis == 'y' ? load == 'z' : load == 'y';
  for (SpecimenSphere& s : specimen.spheres) {
    const Vec3 c = s.centre;
    s.centre = along_x ? Vec3{c.y, c.z, c.x} : Vec3{c.x, -c.z, c.y};
  }
  return specimen;
}

void check_specimen(const Specimen& specimen, const Body& body, Space space,
                    const std::vector<char>& of_body) {
  if (specimen.spheres.empty()) fail<BadInput>("{}: no sphere in the specimen", specimen.source);
  check_coincident(specimen);
  if (unit_hint(specimen, body, space).empty()) check_fit_in(specimen, body, space);
  check_inside(specimen, body, space, of_body);
  check_filled(specimen, body, space);
}

void check_sizes(const Specimen& specimen) {
  if (specimen.spheres.empty()) return;
  std::vector<double> radius;
  for (const SpecimenSphere& s : specimen.spheres) radius.push_back(s.radius);
  const auto middle = radius.begin() + static_cast<std::ptrdiff_t>(radius.size() / 2);
  std::nth_element(radius.begin(), middle, radius.end());
  const double median = *middle;
  // a step goes with the smallest sphere, the time of a test with the largest
  constexpr double most = 1e4;
  for (const SpecimenSphere& s : specimen.spheres) {
    if (s.radius < most * median && s.radius > median / most) continue;
    fail<BadInput>(
        "{}: sphere {} has radius {:.4g} m, {} than the others ({:.4g} m, the median) by a factor above "
        "{:.0e}; remove it, or check its radius",
        place_of(specimen, s), s.id, s.radius, s.radius < median ? "smaller" : "larger", median, most);
  }
}

}  // namespace breccia
