#include "core/assembly.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/cell_list.hpp"
#include "core/error.hpp"
#include "core/space_curve.hpp"
#include "kernels/bond_pass.hpp"

namespace breccia {
namespace {

using std::numbers::pi;

/// Free particles first, then the lower and the upper layer; within each along a Hilbert curve.
std::vector<std::size_t> order_of(const Specimen& specimen, double lower, double upper) {
  std::vector<Vec3> centres;
  centres.reserve(specimen.spheres.size());
  for (const auto& s : specimen.spheres) centres.push_back(s.centre);
  const auto keys = hilbert_keys(centres);
  const auto part = [&](std::size_t k) { return centres[k].z < lower ? 1 : centres[k].z > upper ? 2 : 0; };
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

/// Both ends in one cohesive group, lower id first.
std::vector<Link> links_within(const ParticleTable& p, const std::vector<int>& group, double range,
                               int threads) {
  std::vector<Link> links;
  for (const auto& [a, b] : near_pairs(p.position, p.radius, range, 0.0, threads)) {
    if (group[a] == 0 || group[a] != group[b]) continue;
    const double length = norm(p.position[b] - p.position[a]);
    links.push_back(p.gid[a] < p.gid[b] ? Link{a, b, length} : Link{b, a, length});
  }
  return links;
}

/// beta for a wanted coordination number, by bisection over the pairs' own ratios: exact to one bond.
double range_for_coordination(const ParticleTable& p, const std::vector<int>& group, double wanted,
                              int threads) {
  double widest = 0.2;
  std::vector<double> ratios;
  const auto count = static_cast<std::size_t>(std::llround(0.5 * wanted * static_cast<double>(p.size)));
  for (; widest < 2.0; widest *= 1.6) {
    ratios.clear();
    for (const Link& l : links_within(p, group, widest, threads))
      ratios.push_back(l.length / (p.radius[l.lo] + p.radius[l.hi]) - 1.0);
    if (ratios.size() > count) break;
  }
  if (count == 0 || ratios.size() <= count)
    fail<BadInput>("bonds.coordination: {} bonds per sphere cannot be reached by this specimen; ask for less",
                   wanted);
  std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(count) - 1, ratios.end());
  return ratios[count - 1] + 1e-12;
}

}  // namespace

double Assembly::section() const {
  return body.shape == Shape::box ? body.diameter * body.depth : 0.25 * pi * body.diameter * body.diameter;
}

double Assembly::mantle() const {
  return body.height * (body.shape == Shape::box ? 2.0 * (body.diameter + body.depth) : pi * body.diameter);
}

bool at_mantle(const Body& body, const Vec3& centre, double radius, double mean_radius) {
  const double reach = radius + 0.3 * mean_radius;
  if (body.shape == Shape::box)
    return std::abs(centre.x) + reach > 0.5 * body.diameter || std::abs(centre.y) + reach > 0.5 * body.depth;
  return std::hypot(centre.x, centre.y) + reach > 0.5 * body.diameter;
}

Assembly assemble(const Specimen& specimen, const Body& body, const BondingRule& rule,
                  const Features& features, int threads) {
  Assembly a;
  a.body = body;
  const std::size_t n = specimen.spheres.size();
  for (const auto& s : specimen.spheres) a.mean_radius += s.radius / static_cast<double>(n);
  a.layer = 1.5 * a.mean_radius;
  const double upper = 0.5 * body.height - a.layer;

  ParticleTable& p = a.particles;
  p.resize(n, features);
  std::vector<int> group(n);
  const auto order = order_of(specimen, -upper, upper);
  for (std::size_t row = 0; row < n; ++row) {
    const SpecimenSphere& s = specimen.spheres[order[row]];
    p.gid[row] = s.id;
    p.radius[row] = s.radius;
    p.position[row] = p.reference_position[row] = s.centre;
    group[row] = s.group;
    if (s.centre.z >= -upper && s.centre.z <= upper) p.free = row + 1;
    if (s.centre.z <= upper) a.first_top = row + 1;
    if (at_mantle(body, s.centre, s.radius, a.mean_radius)) a.skin.push_back(static_cast<Row>(row));
  }
  if (p.free == 0 || a.first_top == p.free || a.first_top == n)
    fail<BadInput>(
        "{}: no sphere between or within the end layers (1.5 mean radii) of a body {} m high; "
        "check specimen.height and specimen.axis",
        specimen.source, body.height);

  a.range = rule.coordination ? range_for_coordination(p, group, *rule.coordination, threads) : rule.range;
  std::vector<Link> links = links_within(p, group, a.range, threads);
  if (links.empty())
    fail<BadInput>(
        "{}: no bond found within a range of {} of the radii; check bonds.range and the unit of the file",
        specimen.source, a.range);
  std::sort(links.begin(), links.end(), [](const Link& x, const Link& y) {
    return std::pair(std::min(x.lo, x.hi), std::max(x.lo, x.hi)) <
           std::pair(std::min(y.lo, y.hi), std::max(y.lo, y.hi));
  });

  BondTable& b = a.bonds;
  b.resize(links.size(), features, bond_batch);
  for (std::size_t row = 0; row < b.padded; ++row) {
    const bool padding = row >= links.size();
    const Link& l = links[padding ? links.size() - 1 : row];
    const double smaller = std::min(p.radius[l.lo], p.radius[l.hi]);
    b.gid_lo[row] = p.gid[l.lo];
    b.gid_hi[row] = p.gid[l.hi];
    b.row_lo[row] = l.lo;
    b.row_hi[row] = l.hi;
    b.rest_length[row] = l.length;
    b.area[row] = pi * smaller * smaller;  // of padding too: its stresses and strains stay numbers
    if (!padding && l.length < 0.2 * (p.radius[l.lo] + p.radius[l.hi])) ++a.short_bonds;
  }
  a.coordination = 2.0 * static_cast<double>(links.size()) / static_cast<double>(n);
  return a;
}

}  // namespace breccia
