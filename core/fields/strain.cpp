#include "core/fields/strain.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace breccia {
namespace {

using Matrix = Eigen::Matrix3d;

/// Sums over the bonds of a particle.
struct Neighbourhood {
  Matrix moved = Matrix::Zero(), spread = Matrix::Zero();
};

void add(Neighbourhood& n, const Vec3& apart, const Vec3& moved) {
  const Eigen::Vector3d x(apart.x, apart.y, apart.z), u(moved.x, moved.y, moved.z);
  n.moved += u * x.transpose();
  n.spread += x * x.transpose();
}

Strain strain_of(const Neighbourhood& n, bool plane) {
  Matrix spread = n.spread;
  if (plane) spread(1, 1) = 0.5 * spread.trace();  // nothing lies in front or behind
  const double size = spread.trace() / 3.0;
  constexpr double flat = 1e-3;  // of three directions the one that the neighbours span least
  if (!(size > 0.0) || spread.determinant() < flat * size * size * size) return {};
  const Matrix gradient = n.moved * spread.inverse();
  const Matrix e = 0.5 * (gradient + gradient.transpose());
  return {{e(0, 0), e(1, 1), e(2, 2)}, {e(1, 2), e(2, 0), e(0, 1)}};
}

}  // namespace

double Strain::equivalent() const {
  const double mean = (normal.x + normal.y + normal.z) / 3.0;
  const Vec3 d = normal - Vec3{mean, mean, mean};
  return std::sqrt(2.0 / 3.0 * (dot(d, d) + 2.0 * dot(shear, shear)));
}

std::vector<Strain> strains(const World& w) {
  const ParticleTable& p = w.particles;
  const BondTable& b = w.bonds;
  std::vector<Neighbourhood> around(p.size);
  const auto moved = [&](Row row) { return p.position[row] - p.reference_position[row]; };
  for (std::size_t k = 0; k < b.padded; ++k) {
    if (b.stiffness[k] == 0.0) continue;
    const Row lo = b.row_lo[k], hi = b.row_hi[k];
    const Vec3 apart = p.reference_position[hi] - p.reference_position[lo], u = moved(hi) - moved(lo);
    add(around[lo], apart, u);
    add(around[hi], apart, u);
  }
  std::vector<Strain> all;
  for (const Neighbourhood& n : around) all.push_back(strain_of(n, w.space == Space::two_d));
  return all;
}

double localisation(const World& w) {
  const ParticleTable& p = w.particles;
  const std::vector<Strain> strain = strains(w);
  std::vector<double> size(p.free);
  constexpr double most = 1.0;  // of what has flown off
  for (std::size_t row = 0; row < p.free; ++row) size[row] = std::min(strain[row].equivalent(), most);
  std::vector<std::size_t> order(p.free);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t c) { return std::pair(-size[a], a) < std::pair(-size[c], c); });
  const auto volume = [&](std::size_t row) {
    const double r = p.radius[row];
    return w.space == Space::two_d ? r * r : r * r * r;
  };
  double all = 0.0, whole = 0.0, held = 0.0, share = 0.0;
  for (const std::size_t row : order) all += volume(row), whole += volume(row) * size[row];
  if (!(whole > 0.0)) return 0.0;
  for (const std::size_t row : order) {
    if (held >= 0.9 * whole) break;
    held += volume(row) * size[row];
    share += volume(row);
  }
  return share / all;
}

}  // namespace breccia
