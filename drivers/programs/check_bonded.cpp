#include "drivers/programs/check_bonded.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "core/boundary/platens_and_confinement.hpp"

namespace breccia {
namespace {

/// "2 pieces of 150 and 149 spheres"
std::string describe_pieces(const std::vector<std::size_t>& pieces) {
  std::string text = fmt::format("{} pieces of ", pieces.size());
  constexpr std::size_t most = 3;
  const std::size_t shown = std::min(most, pieces.size());
  for (std::size_t k = 0; k < shown; ++k)
    text += fmt::format("{}{}", k == 0 ? "" : k + 1 < pieces.size() ? ", " : " and ", pieces[k]);
  return text + (pieces.size() > most ? ", ... spheres" : " spheres");
}

std::string_view held_bodies(Support support) {
  switch (support) {
    case Support::ends:
      return "the two ends";
    case Support::strips:
      return "the two strips";
    case Support::halves:
      return "the two halves of the shear box";
    case Support::vice:
      return "the vice and the rest";
  }
  return "?";
}

}  // namespace

std::string describe(const Connection& c) {
  std::string text;
  if (c.pieces.size() > 1) text += fmt::format("; the bonds fall into {}", describe_pieces(c.pieces));
  if (c.loose > 0)
    text += fmt::format("; {} hang{} on nothing, {} of them without a bond",
                        c.loose == 1 ? "1 sphere" : fmt::format("{} spheres", c.loose),
                        c.loose == 1 ? "s" : "", c.unbonded);
  return text;
}

void check_connection(const Connection& c, const Assembly& a, const std::string& source,
                      std::vector<std::string>& warnings) {
  if (!c.joined)
    fail<BadInput>(
        "{}: the specimen is severed: its bonds fall into {}, and none joins {}, so that no load goes from "
        "one to the other; check bonds.range, the cohesive groups of the file, and specimen.height",
        source, describe_pieces(c.pieces), held_bodies(a.grip));
  const double spheres = static_cast<double>(a.particles.size);
  if (!c.by_bonds)
    warnings.push_back(fmt::format(
        "no bonds join {}: the load goes through surfaces that only touch; the bonds fall into {}",
        held_bodies(a.grip), describe_pieces(c.pieces)));
  else if (c.pieces.size() > 1 && static_cast<double>(c.pieces[1]) > 0.01 * spheres)
    warnings.push_back(
        fmt::format("the bonds fall into {}, no bond between them", describe_pieces(c.pieces)));
  if (static_cast<double>(c.loose) > 0.02 * spheres)
    warnings.push_back(fmt::format(
        "{} of {} spheres hang on nothing, {} of them without a bond: no gauge reads them, no pressure acts "
        "on them; check bonds.range and the cohesive groups of the file",
        c.loose, a.particles.size, c.unbonded));
}

void check_lateral_surface(const Assembly& a, bool pressed, const std::string& source,
                           std::vector<std::string>& warnings) {
  const double cover = lateral_cover(a);
  if (pressed && !a.lateral.empty() && is_one_sphere_wide(a))
    fail<BadInput>(
        "{}: the specimen is one sphere wide: no sphere lies beside its axis, and lateral pressure has no "
        "direction; use a wider specimen",
        source);
  if (pressed && cover < 0.3)
    fail<BadInput>(
        "{}: {} spheres that hang together reach the lateral surface and cover {:.3f} of it (packings: 0.65 "
        "to 0.9): the pressure on it would rest on them alone; check specimen.diameter and specimen.centre",
        source, a.lateral.size(), cover);
  if (cover < 0.6)
    warnings.push_back(fmt::format(
        "{} spheres reach the lateral surface and cover {:.2f} of it (packings: 0.65 to 0.9): pressure and "
        "lateral strain rest on them alone; check specimen.diameter",
        a.lateral.size(), cover));
}

void check_area_factor(const AreaFactor& f, const Assembly& a, const Connection& c,
                       std::vector<std::string>& warnings) {
  if (!(f.affine > 0.0)) return;
  const double ratio = f.alpha / f.affine;
  // few bonds a sphere make a network far softer than its affine estimate, without any flaw
  const double bonded = static_cast<double>(a.particles.size - c.unbonded);
  const double neighbours = 2.0 * static_cast<double>(a.bonds.size) / bonded;
  const bool sparse = neighbours < (a.space == Space::two_d ? 3.9 : 6.0);
  if (ratio > (sparse ? 2.5 : 1.5))
    fail<BadInput>(
        "bonds.alpha: \"auto\" would need areas {:.4g} times the bonds' own, {:.3g} times what an intact "
        "packing of {:.1f} bonds per sphere needs: the specimen is softer than its bonds explain (a flaw, a "
        "cut, a thread, loose spheres), and larger areas would hide that and raise all strengths; give "
        "bonds.alpha the value of the intact specimen, or {:.4g}",
        f.alpha, ratio, neighbours, f.affine);
  if (ratio > (sparse ? 1.5 : 1.2) || ratio < 0.7)
    warnings.push_back(fmt::format(
        "alpha {:.4g} is {:.3g} times what an intact packing of {:.1f} bonds per sphere needs ({:.4g}): {}",
        f.alpha, ratio, neighbours, f.affine,
        ratio > 1.0 ? "a flaw, or too few bonds, is made up for by larger areas, which raise all strengths"
                    : "the specimen is stiffer than its bonds explain"));
}

}  // namespace breccia
