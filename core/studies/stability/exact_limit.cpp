#include "core/studies/stability/exact_limit.hpp"

#include <Eigen/Cholesky>

#include <cmath>
#include <functional>
#include <limits>

#include "core/elastic/elastic_network.hpp"
#include "core/world/loop_views.hpp"

namespace breccia {
namespace {

/// M^-1/2 K M^-1/2 for the stiffnesses given, a column at a time.
Eigen::MatrixXd scaled_matrix(const World& w, const std::function<SpringConstants(std::size_t)>& constants) {
  const ParticleTable& p = w.particles;
  const ElasticNetwork net = elastic_network(p, w.bonds, {}, w.options.features.rotation, 1, constants);
  const auto n = static_cast<Eigen::Index>(6 * p.size);
  Eigen::VectorXd by_mass(n);
  for (std::size_t row = 0; row < p.size; ++row) {
    const auto at = static_cast<Eigen::Index>(6 * row);
    by_mass.segment<3>(at).setConstant(1.0 / std::sqrt(p.mass[row]));
    by_mass.segment<3>(at + 3).setConstant(1.0 /
                                           std::sqrt(inertia(inertia_factor(w), p.mass[row], p.radius[row])));
  }
  Eigen::MatrixXd matrix(n, n);
  Eigen::VectorXd unit = Eigen::VectorXd::Zero(n), image(n);
  std::vector<SpringLoad<double>> loads;
  for (Eigen::Index k = 0; k < n; ++k) {
    unit[k] = by_mass[k];
    apply_stiffness(net, unit, loads, image);
    matrix.col(k) = by_mass.cwiseProduct(image);
    unit[k] = 0.0;
  }
  return matrix;
}

}  // namespace

double exact_time_step(const World& w) {
  const BondTable& b = w.bonds;
  if (b.size == 0) return std::numeric_limits<double>::infinity();
  const Eigen::MatrixXd stiffness = scaled_matrix(w, [&](std::size_t k) {
    return SpringConstants{b.stiffness[k], w.shear_ratio.front() * b.stiffness[k]};
  });
  const Eigen::MatrixXd damping = scaled_matrix(w, [&](std::size_t k) {
    return SpringConstants{b.damping.empty() ? 0.0 : b.damping[k], 0.0};
  });
  const GlobalDamping& global = w.options.global_damping;
  const double limit = 1.0 / (1.0 + std::max(global.translation, global.rotation));
  const auto is_stable = [&](double dt) {
    Eigen::MatrixXd left = -0.25 * dt * dt * stiffness - 0.5 * dt * damping;
    left.diagonal().array() += limit;
    return left.llt().info() == Eigen::Success;
  };
  double low = 0.0, high = w.critical_dt;
  while (is_stable(high)) low = high, high *= 1.05;
  while (high - low > 1e-7 * high) {
    const double middle = 0.5 * (low + high);
    (is_stable(middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace breccia
