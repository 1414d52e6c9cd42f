#include "core/bonding/bond_area.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/geometry/voronoi_cells.hpp"

namespace breccia {
namespace {

using std::numbers::pi;

void check(const ParticleTable& p, const BondTable& b, std::span<const Row> lateral) {
  for (std::size_t k = 0; k < p.size; ++k)
    if (!(p.radius[k] > 0.0) || !std::isfinite(p.radius[k]))
      fail<BadInput>("specimen: particle {} has a radius of {} m; radii must be above zero", p.gid[k],
                     p.radius[k]);
  for (std::size_t k = 0; k < b.size; ++k)
    if (b.row_lo[k] >= p.size || b.row_hi[k] >= p.size || b.row_lo[k] == b.row_hi[k])
      fail<BadInput>("bond {}: joins rows {} and {} of {} particles", k, b.row_lo[k], b.row_hi[k], p.size);
  for (const Row row : lateral)
    if (row >= p.size) fail<BadInput>("lateral: row {} of {} particles", row, p.size);
}

/// Section of a cylinder of radius r, or of a strip.
double section(double r, Space space) { return space == Space::three_d ? pi * r * r : 2.0 * r; }

double equivalent(double r_i, double r_j) { return 2.0 * r_i * r_j / (r_i + r_j); }  // (S4.31)

/// (S4.28): the radius of the cylinder that is as stiff as a truncated cone from one sphere to the
/// other, A = pi r_i r_j; in two dimensions a wedge, 2 (r_j - r_i)/ln(r_j/r_i).
double cone_radius(double r_i, double r_j, Space space) {
  if (space == Space::three_d) return std::sqrt(r_i * r_j);
  const double x = (r_j - r_i) / r_i;
  return std::abs(x) < 1e-6 ? 0.5 * (r_i + r_j) : (r_j - r_i) / std::log1p(x);
}

template <class Radius>
std::vector<double> pair_areas(const ParticleTable& p, const BondTable& b, Space space,
                               const Radius& radius) {
  std::vector<double> area(b.size);
  for (std::size_t k = 0; k < b.size; ++k)
    area[k] = section(radius(p.radius[b.row_lo[k]], p.radius[b.row_hi[k]]), space);
  return area;
}

/// (B9): surface of a regular polyhedron over that of its inscribed sphere: exact for the five
/// solids, straight in between as in Santasusana's table C.2 (whose entries for n = 7, 11, 16 stray
/// from that line by 0.04, 0.2, 0.5 %: misprints).
double polyhedron_ratio(double n) {
  constexpr std::array<double, 5> faces{4, 6, 8, 12, 20};
  const double root5 = std::sqrt(5.0), root3 = std::sqrt(3.0);
  const std::array<double, 5> ratio{6 * root3 / pi, 6 / pi, 3 * root3 / pi,
                                    150 * std::sqrt((5 + 2 * root5) / 5) / ((25 + 11 * root5) * pi),
                                    30 * root3 / ((7 + 3 * root5) * pi)};
  n = std::clamp(n, faces.front(), faces.back());
  std::size_t k = 1;
  while (n > faces[k]) ++k;
  return ratio[k - 1] + (ratio[k] - ratio[k - 1]) * (n - faces[k - 1]) / (faces[k] - faces[k - 1]);
}

/// Perimeter of a regular polygon over that of its inscribed circle.
double polygon_ratio(double n) {
  n = std::clamp(n, 3.0, 14.0);
  return n * std::tan(pi / n) / pi;
}

double shape_ratio(double n, Space space) {
  return space == Space::three_d ? polyhedron_ratio(n) : polygon_ratio(n);
}

/// (B9): neighbours of a particle inside. Solid: 11, the mean of dense packings (thesis, section
/// 4.6.2). Plane: 6; cells that tile a plane have six sides on average, by Euler's formula,
/// whatever the packing.
double inner_neighbours(Space space) { return space == Space::three_d ? 11.0 : 6.0; }

std::vector<double> polyhedron_areas(const ParticleTable& p, const BondTable& b, std::span<const Row> lateral,
                                     Space space) {
  std::vector<double> area = pair_areas(p, b, space, equivalent);
  std::vector<double> count(p.size), sum(p.size), gamma(p.size);
  for (std::size_t k = 0; k < b.size; ++k)
    for (const Row row : {b.row_lo[k], b.row_hi[k]}) count[row] += 1.0, sum[row] += area[k];
  std::vector<char> at_lateral(p.size, 0);
  for (const Row row : lateral) at_lateral[row] = 1;
  const double inner = inner_neighbours(space);
  for (std::size_t row = 0; row < p.size; ++row) {
    if (count[row] == 0.0) continue;
    const double r = p.radius[row];
    const double surface = space == Space::three_d ? 4.0 * pi * r * r : 2.0 * pi * r;
    // a particle at the lateral surface is surrounded in part: each neighbour gets what it would
    // get inside
    const double ratio =
        at_lateral[row] ? shape_ratio(inner, space) * count[row] / inner : shape_ratio(count[row], space);
    gamma[row] = ratio * surface / sum[row];  // (S4.30)
  }
  for (std::size_t k = 0; k < b.size; ++k) {
    const Row i = b.row_lo[k], j = b.row_hi[k];
    // (S4.32)
    area[k] *= at_lateral[i] == at_lateral[j] ? 0.5 * (gamma[i] + gamma[j])
               : at_lateral[i]                ? gamma[j]
                                              : gamma[i];
  }
  return area;
}

std::vector<double> voronoi_areas(const ParticleTable& p, const BondTable& b, const Body& body, Space space,
                                  int threads, char axis) {
  const VoronoiCells cells = voronoi_cells(p.reference_position, p.radius, body, space, threads, axis);
  std::vector<double> area(b.size);
  for (std::size_t k = 0; k < b.size; ++k) {
    const auto [i, j] = std::minmax(b.row_lo[k], b.row_hi[k]);
    const auto face =
        std::lower_bound(cells.faces.begin(), cells.faces.end(), std::pair(i, j),
                         [](const VoronoiFace& f, const auto& ends) { return std::pair(f.a, f.b) < ends; });
    if (face != cells.faces.end() && face->a == i && face->b == j) area[k] = face->area;  // (B10)
  }
  return area;
}

}  // namespace

std::vector<double> bond_areas(AreaRule rule, const ParticleTable& particles, const BondTable& bonds,
                               std::span<const Row> lateral, const Body& body, Space space, int threads,
                               char axis) {
  check(particles, bonds, lateral);
  switch (rule) {
    case AreaRule::minimum:
      break;
    case AreaRule::harmonic:
      return pair_areas(particles, bonds, space, equivalent);
    case AreaRule::cone:
      return pair_areas(particles, bonds, space,
                        [&](double a, double b) { return cone_radius(a, b, space); });
    case AreaRule::polyhedron:
      return polyhedron_areas(particles, bonds, lateral, space);
    case AreaRule::voronoi:
      return voronoi_areas(particles, bonds, body, space, threads, axis);
  }
  return pair_areas(particles, bonds, space, smaller<double>);  // (P21)
}

}  // namespace breccia
