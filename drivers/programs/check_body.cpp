#include "drivers/programs/check_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "core/geometry/surface_fit.hpp"
#include "io/specimens/read_specimen.hpp"

namespace breccia {
namespace {

/// Refuses, or warns.
void tell(Fit fit, const std::string& source, const std::string& text, std::vector<std::string>& warnings) {
  if (fit == Fit::wrong) fail<BadInput>("{}: {}", source, text);
  if (fit == Fit::doubtful) warnings.push_back(text);
}

std::string millimetres(double metres) { return fmt::format("{:.4g} mm", 1e3 * metres); }

/// A size of the nominal body against the two faces of the spheres across it.
struct Size {
  std::string_view key, faces;
  double nominal;  ///< m
};

std::string text_of(const Size& size, const SurfaceGap& gap, double mean_radius) {
  const double fits = size.nominal - 2.0 * (gap.median - usual_gap) * mean_radius;
  if (!std::isfinite(fits) || fits <= 0.0)
    return fmt::format("{} = {}: no sphere is near most of the {}; check the sizes of the body", size.key,
                       millimetres(size.nominal), size.faces);
  return fmt::format(
      "{} = {} does not fit the spheres: the {} {} {} {} the nominal place, {:.2f} mean radii (walls leave 0 "
      "to 0.16 beyond it); {} would fit",
      size.key, millimetres(size.nominal), size.faces, size.faces.back() == 's' ? "lie" : "lies",
      millimetres(std::abs(gap.median) * mean_radius), gap.median > 0.0 ? "inside" : "beyond",
      std::abs(gap.median), millimetres(fits));
}

std::string describe(const SurfaceFit& fit) {
  std::string text =
      fmt::format("spheres beyond the nominal body (+) or behind it (-), in mean radii: sides {:+.2f}",
                  -fit.across.median);
  if (fit.depth) text += fmt::format(" and {:+.2f}", -fit.depth->median);
  if (fit.height) text += fmt::format(", ends {:+.2f}", -fit.height->median);
  return text + fmt::format("; middle off by {:.2f}", norm(fit.offset));
}

/// A hole that the case says and the spheres do not have is refused; one that they have and the
/// case does not say, warned about.
void check_hole(const Body& nominal, const Specimen& placed, const MainBody& body, double mean_radius,
                std::vector<std::string>& warnings) {
  if (nominal.shape == Shape::disc) return;
  std::size_t within = 0, spheres = 0;
  double surface = std::numeric_limits<double>::infinity(), centre = surface;
  for (std::size_t k = 0; k < placed.spheres.size(); ++k) {
    if (!body.has[k]) continue;
    const SpecimenSphere& s = placed.spheres[k];
    const double away = std::hypot(s.centre.x, s.centre.y);
    ++spheres;
    within += away + 0.5 * s.radius < 0.5 * nominal.hole;
    centre = std::min(centre, away);
    surface = std::min(surface, away - s.radius);
  }
  if (50 * within > spheres || (nominal.hole > 0.0 && within > 0 && spheres < 50))
    fail<BadInput>(
        "{}: specimen.hole = {}: {} spheres lie within it; check the hole, and that it runs along the middle",
        placed.source, millimetres(nominal.hole), within);
  if (nominal.hole == 0.0 && centre > 2.5 * mean_radius)
    warnings.push_back(
        fmt::format("no sphere is within {} of the axis: if the specimen has a hole, say specimen.hole = "
                    "\"{}\"; stresses are "
                    "over the whole section now",
                    millimetres(surface), millimetres(2.0 * surface)));
}

}  // namespace

std::vector<std::string> check_body(const Case& c, const Specimen& placed, const MainBody& body,
                                    const Specimen& as_read, Progress& progress) {
  const SpecimenCase& s = c.specimen;
  std::vector<Vec3> centre;
  std::vector<double> radius;
  double mean_radius = 0.0;
  for (std::size_t k = 0; k < placed.spheres.size(); ++k) {
    if (!body.has[k]) continue;
    centre.push_back(placed.spheres[k].centre), radius.push_back(placed.spheres[k].radius);
    mean_radius += radius.back();
  }
  mean_radius /= static_cast<double>(radius.size());
  const SurfaceFit fit = fit_surface(s.body, s.space, centre, radius, mean_radius);
  say(progress, describe(fit));
  std::vector<std::string> warnings;
  const bool box = s.body.shape == Shape::box;
  const std::string apart =
      body.pieces > 1 ? fmt::format("; the spheres lie in {} pieces apart from each other", body.pieces) : "";
  const auto check_size = [&](const Size& size, const SurfaceGap& gap) {
    Fit fit_of_size = judge(gap);
    // what has come apart is wider than it was, which is no slip in the case
    if (fit_of_size == Fit::wrong && gap.median < 0.0 && body.pieces > 1) fit_of_size = Fit::doubtful;
    tell(fit_of_size, placed.source, text_of(size, gap, mean_radius) + apart, warnings);
  };
  const double away = std::max({std::abs(fit.offset.x), std::abs(fit.offset.y), std::abs(fit.offset.z)});
  if (judge_offset(away) != Fit::good) {
    const Vec3 middle = s.centre ? *s.centre : middle_of(as_read, body.has);
    const Vec3 right = middle + way_in_file(as_read, mean_radius * fit.offset, s.axis, s.space);
    tell(
        judge_offset(away), placed.source,
        fmt::format("specimen.centre: the spheres' own middle lies {} away, {:.2f} mean radii; "
                    "[{:.4g}, {:.4g}, {:.4g}] would fit",
                    millimetres(norm(fit.offset) * mean_radius), norm(fit.offset), right.x, right.y, right.z),
        warnings);
  }
  check_hole(s.body, placed, body, mean_radius, warnings);
  check_size({"specimen.diameter", box ? "sides" : "lateral surface", s.body.diameter}, fit.across);
  if (fit.depth) check_size({"specimen.depth", "sides", s.body.depth}, *fit.depth);
  if (fit.height) check_size({"specimen.height", "ends", s.body.height}, *fit.height);
  return warnings;
}

}  // namespace breccia
