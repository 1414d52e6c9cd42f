#include "core/time_step.hpp"

#include <Spectra/SymEigsSolver.h>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/elastic_network.hpp"
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

/// M^-1/2 K M^-1/2 of a network, as Spectra wants it.
struct ScaledNetwork {
  using Scalar = double;
  ElasticNetwork network;
  Eigen::VectorXd by_mass;  ///< 1/sqrt of mass and inertia
  mutable Eigen::VectorXd in, out;

  Eigen::Index rows() const { return by_mass.size(); }
  Eigen::Index cols() const { return by_mass.size(); }
  void perform_op(const double* x, double* y) const {
    in = by_mass.cwiseProduct(Eigen::Map<const Eigen::VectorXd>(x, rows()));
    apply_stiffness(network, in, out);
    Eigen::Map<Eigen::VectorXd>(y, rows()) = by_mass.cwiseProduct(out);
  }
};

Eigen::VectorXd roots_of_masses(const ParticleTable& p, const Freedom& freedom) {
  Eigen::VectorXd by_mass(static_cast<Eigen::Index>(6 * p.size));
  for (std::size_t row = 0; row < p.size; ++row) {
    const auto at = static_cast<Eigen::Index>(6 * row);
    by_mass.segment<3>(at).setConstant(1.0 / std::sqrt(p.mass[row]));
    by_mass.segment<3>(at + 3).setConstant(
        1.0 / std::sqrt(inertia(freedom.inertia_factor, p.mass[row], p.radius[row])));
    if (freedom.plane) by_mass[at + 1] = by_mass[at + 3] = by_mass[at + 5] = 0.0;
  }
  return by_mass;
}

double rayleigh_quotient(const ScaledNetwork& net, const Eigen::VectorXd& x) {
  Eigen::VectorXd y(x.size());
  net.perform_op(x.data(), y.data());
  return x.dot(y) / x.squaredNorm();
}

}  // namespace

double critical_time_step(const ParticleTable& p, const BondTable& b, double shear_ratio,
                          const Freedom& freedom, double damping, int threads) {
  const auto spring = [&](std::size_t k) {
    return SpringConstants{b.stiffness[k], shear_ratio * b.stiffness[k]};
  };
  const auto dashpot = [&](std::size_t k) {
    return SpringConstants{b.damping.empty() ? 0.0 : b.damping[k], 0.0};
  };
  const double limit = 1.0 / (1.0 + damping);
  const double proven = proven_time_step(p, b, shear_ratio, freedom, damping, threads);
  // one network takes all constants in turn: it is the largest thing that a run ever holds beside its tables
  ScaledNetwork net{elastic_network(p, b, freedom.rotation, threads, spring),
                    roots_of_masses(p, freedom),
                    {},
                    Eigen::VectorXd(static_cast<Eigen::Index>(6 * p.size))};
  double dt = proven;
  Eigen::VectorXd mode;
  constexpr int turns = 6;
  for (int turn = 0; turn < turns; ++turn) {
    set_constants(net.network, [&](std::size_t k) {  // dt^2 K/4 + dt C/2
      const double stiff = 0.25 * dt * dt * b.stiffness[k];
      return SpringConstants{stiff + 0.5 * dt * dashpot(k).normal, shear_ratio * stiff};
    });
    Spectra::SymEigsSolver<ScaledNetwork> solver(net, 1, std::min<Eigen::Index>(8, net.rows()));
    if (mode.size() > 0)
      solver.init(mode.data());
    else
      solver.init();
    solver.compute(Spectra::SortRule::LargestAlge, 300, 1e-3);
    if (solver.info() != Spectra::CompInfo::Successful) return proven;
    mode = solver.eigenvectors().col(0);
    // the step at which this mode would reach the limit; it falls to the answer as the mode settles
    set_constants(net.network, spring);
    const double s = 0.25 * rayleigh_quotient(net, mode);
    set_constants(net.network, dashpot);
    const double d = 0.5 * rayleigh_quotient(net, mode);
    const double next = 2.0 * limit / (d + std::sqrt(d * d + 4.0 * s * limit));
    const bool settled = std::abs(next - dt) < 2e-3 * dt;
    dt = next;
    if (settled) break;
  }
  return 0.98 * dt;
}

double proven_time_step(const ParticleTable& p, const BondTable& b, double shear_ratio,
                        const Freedom& freedom, double damping, int threads) {
  std::vector<std::vector<Row>> bonds_of(p.size);
  for (std::size_t k = 0; k < b.size; ++k) {
    bonds_of[b.row_lo[k]].push_back(static_cast<Row>(k));
    bonds_of[b.row_hi[k]].push_back(static_cast<Row>(k));
  }
  std::vector<Alone> alone(p.size);
  for_rows(p.size, threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t row = first; row < last; ++row) {
      // unknowns scaled by the square roots of mass and inertia: M becomes the identity
      const double by_mass = 1.0 / std::sqrt(p.mass[row]);
      const double by_inertia = 1.0 / std::sqrt(inertia(freedom.inertia_factor, p.mass[row], p.radius[row]));
      Block stiffness = Block::Zero(), damper = Block::Zero();
      for (const Row k : bonds_of[row]) {
        const Row other = b.row_lo[k] == row ? b.row_hi[k] : b.row_lo[k];
        const Vec3 l = p.reference_position[other] - p.reference_position[row];
        const Eigen::Vector3d n = Eigen::Vector3d(l.x, l.y, l.z).normalized();
        const double arm =
            freedom.rotation ? b.rest_length[k] * p.radius[row] / (p.radius[row] + p.radius[other]) : 0.0;
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
