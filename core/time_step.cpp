#include "core/time_step.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "kernels/integrate.hpp"

namespace breccia {
namespace {

using Block = Eigen::Matrix<double, 6, 6>;

/// Largest eigenvalues of M^-1 K and M^-1 C of a particle whose neighbours are fixed.
struct Alone {
  double stiffness = 0;  ///< 1/s^2
  double damping = 0;    ///< 1/s
};

double largest_eigenvalue(const Block& block) {
  return Eigen::SelfAdjointEigenSolver<Block>(block, Eigen::EigenvaluesOnly).eigenvalues()[5];
}

}  // namespace

double stable_time_step(const ParticleTable& p, const BondTable& b, double shear_ratio, double damping, int threads) {
  std::vector<std::vector<Row>> bonds_of(p.size);
  for (std::size_t k = 0; k < b.size; ++k) {
    bonds_of[b.row_lo[k]].push_back(static_cast<Row>(k));
    bonds_of[b.row_hi[k]].push_back(static_cast<Row>(k));
  }
  const bool rotation = !p.spin.empty();
  std::vector<Alone> alone(p.size);
  for_rows(p.size, threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t row = first; row < last; ++row) {
      // unknowns scaled by the square roots of mass and inertia: M becomes the identity
      const double by_mass = 1.0 / std::sqrt(p.mass[row]);
      const double by_inertia = 1.0 / std::sqrt(sphere_inertia(p.mass[row], p.radius[row]));
      Block stiffness = Block::Zero(), damper = Block::Zero();
      for (const Row k : bonds_of[row]) {
        const Row other = b.row_lo[k] == row ? b.row_hi[k] : b.row_lo[k];
        const Vec3 l = p.reference_position[other] - p.reference_position[row];
        const Eigen::Vector3d n = Eigen::Vector3d(l.x, l.y, l.z).normalized();
        const double arm = rotation ? b.rest_length[k] * p.radius[row] / (p.radius[row] + p.radius[other]) : 0.0;
        // elongation and slip at the contact per unit of this end's displacement and rotation
        Eigen::Matrix<double, 3, 6> slip = Eigen::Matrix<double, 3, 6>::Zero();
        slip.leftCols<3>() = by_mass * (Eigen::Matrix3d::Identity() - n * n.transpose());
        Eigen::Matrix3d turn;  // theta x n
        turn << 0, n.z(), -n.y(), -n.z(), 0, n.x(), n.y(), -n.x(), 0;
        slip.rightCols<3>() = arm * by_inertia * turn;
        Eigen::Matrix<double, 6, 1> along = Eigen::Matrix<double, 6, 1>::Zero();
        along.head<3>() = by_mass * n;
        stiffness += b.stiffness[k] * (along * along.transpose() + shear_ratio * slip.transpose() * slip);
        if (!b.damping.empty()) damper += b.damping[k] * along * along.transpose();
      }
      alone[row] = {largest_eigenvalue(stiffness), largest_eigenvalue(damper)};
    }
  });
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < b.size; ++k) {
    const Alone &lo = alone[b.row_lo[k]], &hi = alone[b.row_hi[k]];
    // dt^2 s + dt d = 1/(1 + alpha)
    const double s = 0.25 * (lo.stiffness + hi.stiffness), d = 0.5 * (lo.damping + hi.damping);
    const double limit = 1.0 / (1.0 + damping);
    step = std::min(step, 2.0 * limit / (d + std::sqrt(d * d + 4.0 * s * limit)));
  }
  return step;
}

}  // namespace breccia
