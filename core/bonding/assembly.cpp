#include "core/bonding/assembly.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/base/error.hpp"
#include "core/bonding/bond_area.hpp"
#include "core/bonding/several_materials.hpp"
#include "core/geometry/cell_list.hpp"
#include "core/geometry/space_curve.hpp"
#include "kernels/loops/bond_pass.hpp"

namespace breccia {
namespace {

using std::numbers::pi;

enum Part { free_part = 0, lower_part = 1, upper_part = 2 };

/// Which body of the loading a particle belongs to. (B60) (B61) (B62)
struct Holder {
  Support grip;
  double edge;        ///< m; ends: height where a layer begins; strips: radius where a strip begins
  double half_width;  ///< m; strips: of the strip; halves: height of the shear zone
  const Body* body;
  double mean_radius;

  Part operator()(const SpecimenSphere& s) const {
    const Vec3& x = s.centre;
    const Part side = x.z < 0.0 ? lower_part : upper_part;
    switch (grip) {
      case Support::ends:
        return std::abs(x.z) > edge ? side : free_part;
      case Support::strips:
        return std::abs(x.x) < half_width && std::hypot(x.x, x.z) + s.radius > edge ? side : free_part;
      case Support::halves:
        return std::abs(x.z) > edge || (std::abs(x.z) > half_width &&
                                        at_lateral_surface(*body, Space::three_d, x, s.radius, mean_radius))
                   ? side
                   : free_part;
      case Support::vice:
        return x.z < -edge || (x.z < 0.0 && std::abs(x.x) > 0.5 * body->diameter - 1.5 * mean_radius)
                   ? lower_part
                   : free_part;
    }
    return free_part;
  }
};

/// @param a  with its layer and its strips
Holder holder_of(const Assembly& a, const Body& body) {
  const Support grip = a.grip;
  const double mean_radius = a.mean_radius;
  // (B61): of the spheres that reach that near the lateral surface. With centres that near only,
  // the strips crush their way in at 2.4 MPa where the disc would split at 2.8 (cement, 15,070
  // spheres)
  if (grip == Support::strips)
    return {grip, 0.5 * body.diameter - a.layer, 0.5 * a.strip_width, &body, mean_radius};
  // a shear box leaves a band of five mean radii free
  return {grip, 0.5 * body.height - 1.5 * mean_radius, 2.5 * mean_radius, &body, mean_radius};
}

/// Free particles first, then the lower and the upper body; within each along a Hilbert curve.
/// (B96)
/// @param all_free  nobody is held
std::vector<std::size_t> order_of(const Specimen& specimen, const Holder& part_of, bool all_free) {
  std::vector<Vec3> centres;
  centres.reserve(specimen.spheres.size());
  for (const auto& s : specimen.spheres) centres.push_back(s.centre);
  const auto keys = hilbert_keys(centres);
  const auto part = [&](std::size_t k) { return all_free ? free_part : part_of(specimen.spheres[k]); };
  std::vector<std::size_t> order(centres.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tuple(part(a), keys[a], specimen.spheres[a].id) <
           std::tuple(part(b), keys[b], specimen.spheres[b].id);
  });
  return order;
}

struct Link {
  Row lo, hi;  ///< rows of the lower and the higher global id
  double length;
};

/// Who is bonded to whom.
struct Groups {
  std::vector<int> of;  ///< cohesive group of each particle
  bool across = false;  ///< bonds between groups

  bool are_bonded(Row a, Row b) const { return of[a] != 0 && of[b] != 0 && (across || of[a] == of[b]); }
};

/// Both ends may be bonded, lower id first.
std::vector<Link> links_within(const ParticleTable& p, const Groups& groups, double range, int threads) {
  std::vector<Link> links;
  for (const auto& [a, b] : near_pairs(p.position, p.radius, range, 0.0, threads)) {  // (P16)
    if (!groups.are_bonded(a, b)) continue;
    const double length = norm(p.position[b] - p.position[a]);
    links.push_back(p.gid[a] < p.gid[b] ? Link{a, b, length} : Link{b, a, length});
  }
  return links;
}

/// beta for a wanted coordination number, from the pairs' own ratios: exact to one bond. (B7)
double range_for_coordination(const ParticleTable& p, const Groups& groups, double wanted, int threads) {
  double widest = 0.2;
  std::vector<double> ratios;
  const auto count = static_cast<std::size_t>(std::llround(0.5 * wanted * static_cast<double>(p.size)));
  for (; widest < 2.0; widest *= 1.6) {
    ratios.clear();
    for (const Link& l : links_within(p, groups, widest, threads))
      ratios.push_back(l.length / (p.radius[l.lo] + p.radius[l.hi]) - 1.0);
    if (ratios.size() > count) break;
  }
  if (count == 0 || ratios.size() <= count)
    fail<BadInput>("bonds.coordination: {} bonds per sphere cannot be reached by this specimen; ask for less",
                   wanted);
  std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(count) - 1, ratios.end());
  return ratios[count - 1] + 1e-12;
}

/// Row in the scene's materials: the first is everybody's.
LawIndex material_of(const std::vector<int>& groups, int group) {
  const auto at = std::find(groups.begin(), groups.end(), group);
  return at == groups.end() ? LawIndex{0} : static_cast<LawIndex>(at - groups.begin() + 1);
}

/// Fills the bond table; sorted links, padded with copies of the last that have no stiffness.
void set_bonds(Assembly& a, const std::vector<Link>& links, const Features& features, std::size_t materials) {
  const ParticleTable& p = a.particles;
  BondTable& b = a.bonds;
  b.resize(links.size(), features, bond_batch);
  for (std::size_t row = 0; row < b.padded; ++row) {
    const Link& l = links[std::min(row, links.size() - 1)];
    b.gid_lo[row] = p.gid[l.lo];
    b.gid_hi[row] = p.gid[l.hi];
    b.row_lo[row] = l.lo;
    b.row_hi[row] = l.hi;
    b.rest_length[row] = l.length;
    if (!b.law.empty()) b.law[row] = law_between(p.material[l.lo], p.material[l.hi], materials);
  }
}

/// Areas of the bonds, of padding too: its stresses and strains stay numbers. Bonds without an area
/// are dropped.
void set_areas(Assembly& a, const BondingRule& rule, const Features& features, int threads) {
  const auto areas = [&](AreaRule which) {
    return bond_areas(which, a.particles, a.bonds, a.lateral, a.body, a.space, threads,
                      a.body.on_edge ? 'y' : 'z');
  };
  std::vector<double> area = areas(rule.area), strength;
  if (rule.strength_area) strength = areas(*rule.strength_area);
  std::vector<Link> kept;
  std::vector<std::size_t> from;
  for (std::size_t k = 0; k < a.bonds.size; ++k) {
    if (!(area[k] > 0.0) || (!strength.empty() && !(strength[k] > 0.0))) continue;
    kept.push_back({a.bonds.row_lo[k], a.bonds.row_hi[k], a.bonds.rest_length[k]});
    from.push_back(k);
  }
  if (kept.empty()) fail<BadInput>("bonds.area: no bond of this specimen has an area; use \"minimum\"");
  a.dropped_bonds = a.bonds.size - kept.size();
  if (a.dropped_bonds > 0) set_bonds(a, kept, features, rule.materials.size() + 1);
  BondTable& b = a.bonds;
  if (!strength.empty()) b.strength_area.resize(b.padded);
  for (std::size_t row = 0; row < b.padded; ++row) {
    const std::size_t k = from[std::min(row, from.size() - 1)];
    b.area[row] = area[k];
    if (!strength.empty()) b.strength_area[row] = strength[k];
  }
  const auto& r = a.particles.radius;
  for (std::size_t row = 0; row < b.size; ++row)
    if (b.rest_length[row] < 0.2 * (r[b.row_lo[row]] + r[b.row_hi[row]])) ++a.short_bonds;
}

}  // namespace

double Assembly::section() const {
  const double whole =
      body.shape == Shape::box ? body.diameter * body.depth : 0.25 * pi * body.diameter * body.diameter;
  return whole - 0.25 * pi * body.hole * body.hole;
}

double Assembly::lateral_surface() const {
  if (space == Space::two_d) return 2.0 * body.height * body.depth;  // the two sides of a rectangle
  return body.height * (body.shape == Shape::box ? 2.0 * (body.diameter + body.depth) : pi * body.diameter);
}

double Assembly::length() const { return body.on_edge ? body.diameter : body.height; }

double Assembly::load_section() const {
  // the tension in the middle of a disc under two opposite loads is 2P/(pi D L)
  return grip == Support::strips ? 0.5 * pi * body.diameter * body.height : section();  // (B75)
}

bool at_lateral_surface(const Body& body, Space space, const Vec3& centre, double radius,
                        double mean_radius) {
  const double reach = radius + 0.3 * mean_radius;
  if (space == Space::two_d && body.shape == Shape::box)
    return std::abs(centre.x) + reach > 0.5 * body.diameter;
  if (body.shape == Shape::box)
    return std::abs(centre.x) + reach > 0.5 * body.diameter || std::abs(centre.y) + reach > 0.5 * body.depth;
  return std::hypot(centre.x, body.on_edge ? centre.z : centre.y) + reach > 0.5 * body.diameter;
}

Assembly assemble(const Specimen& specimen, const Body& body, const BondingRule& rule,
                  const Features& features, int threads, bool rotation) {
  Assembly a;
  a.body = body;
  a.space = rule.space;
  a.grip = rule.grip;
  a.rotation = rotation;
  const std::size_t n = specimen.spheres.size();
  for (const auto& s : specimen.spheres) a.mean_radius += s.radius / static_cast<double>(n);
  a.layer = 1.5 * a.mean_radius;
  if (rule.grip == Support::strips) {
    a.planes = rule.strips.planes;
    a.layer = rule.strips.depth.value_or(2.5 * a.mean_radius);
    a.strip_width = rule.strips.width.value_or(0.15 * body.diameter);
  }
  const Holder part_of = holder_of(a, body);

  ParticleTable& p = a.particles;
  p.resize(n, features);
  Groups groups{std::vector<int>(n), rule.across};
  const auto order = order_of(specimen, part_of, a.planes);
  for (std::size_t row = 0; row < n; ++row) {
    const SpecimenSphere& s = specimen.spheres[order[row]];
    p.gid[row] = s.id;
    p.radius[row] = s.radius;
    p.position[row] = p.reference_position[row] = s.centre;
    groups.of[row] = s.group;
    if (!p.material.empty()) p.material[row] = material_of(rule.materials, s.group);
    const Part part = a.planes ? free_part : part_of(s);
    if (part == free_part) p.free = row + 1;
    if (part != upper_part) a.first_top = row + 1;
    if (at_lateral_surface(body, a.space, s.centre, s.radius, a.mean_radius))
      a.lateral.push_back(static_cast<Row>(row));
  }
  if (a.planes) a.layer = 0.0;
  const bool has_top = rule.grip != Support::vice;
  if (!a.planes && (p.free == 0 || a.first_top == p.free || (has_top && a.first_top == n)))
    fail<BadInput>(
        "{}: no sphere between or within the {} ({:.3g} mean radii) of a body {} m long; "
        "check specimen.height, specimen.diameter and specimen.axis{}",
        specimen.source, rule.grip == Support::strips ? "strips" : "end layers", a.layer / a.mean_radius,
        a.length(), rule.grip == Support::strips ? ", test.strip_width and test.strip_depth" : "");

  if (rule.grip == Support::halves && part_of.half_width >= part_of.edge)
    fail<BadInput>(
        "specimen.height: a shear box leaves five mean radii free between its halves, and 1.5 are held at "
        "each "
        "end: {:.3g} m, where the body has {:.3g} m; take a higher body or smaller spheres",
        8.0 * a.mean_radius, body.height);

  a.range = rule.coordination ? range_for_coordination(p, groups, *rule.coordination, threads) : rule.range;
  std::vector<Link> links = links_within(p, groups, a.range, threads);
  if (links.empty())
    fail<BadInput>(
        "{}: no bond found within a range of {} of the radii; check bonds.range and the unit of the file",
        specimen.source, a.range);
  std::sort(links.begin(), links.end(), [](const Link& x, const Link& y) {
    return std::pair(std::min(x.lo, x.hi), std::max(x.lo, x.hi)) <
           std::pair(std::min(y.lo, y.hi), std::max(y.lo, y.hi));
  });

  set_bonds(a, links, features, rule.materials.size() + 1);
  set_areas(a, rule, features, threads);
  a.coordination = 2.0 * static_cast<double>(a.bonds.size) / static_cast<double>(n);
  return a;
}

}  // namespace breccia
