#include "core/elastic/critical_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "core/base/largest_eigenvalue.hpp"
#include "core/base/threads.hpp"
#include "core/elastic/elastic_network.hpp"
#include "core/tables/laws.hpp"
#include "kernels/loops/integrate.hpp"

namespace breccia {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Of the stability number in a run.
constexpr double number_error = 0.02, number_chance = 1e-3;

/// 1/sqrt of mass and inertia, zero where a particle cannot move.
Eigen::VectorXd roots_of_masses(const StepScene& s) {
  const ParticleTable& p = s.particles;
  Eigen::VectorXd by_mass(static_cast<Eigen::Index>(6 * p.size));
  for (std::size_t row = 0; row < p.size; ++row) {
    const auto at = static_cast<Eigen::Index>(6 * row);
    by_mass.segment<3>(at).setConstant(1.0 / std::sqrt(p.mass[row]));
    by_mass.segment<3>(at + 3).setConstant(
        1.0 / std::sqrt(inertia(s.freedom.inertia_factor, p.mass[row], p.radius[row])));
    if (!s.fixed.empty() && s.fixed[row]) by_mass.segment<6>(at).setZero();
    if (s.freedom.plane) by_mass[at + 1] = by_mass[at + 3] = by_mass[at + 5] = 0.0;
  }
  return by_mass;
}

/// True unless the bond is broken and too far open to be pressed. (B42)
bool can_press(const StepScene& s, std::size_t k) {
  if (bond_state(s.bonds, k) == BondState::intact) return true;
  const auto& x = s.particles.position;
  return norm(x[s.bonds.row_hi[k]] - x[s.bonds.row_lo[k]]) <= s.bonds.rest_length[k] + s.reach;
}

/// k_s/k_n of a bond, or of a contact: rows as of an elastic network.
double shear_ratio_at(const StepScene& s, std::size_t k) {
  return k < s.bonds.size ? of_law(s.shear_ratio, s.bonds.law, k)
                          : of_law(s.shear_ratio, s.contacts.law, k - s.bonds.size);
}

/// dt^2 K/4 + dt C/2 of a bond, or of a contact: rows as of an elastic network. (B42)
SpringConstants step_constants(const StepScene& s, std::size_t k, double dt) {
  const bool bond = k < s.bonds.size;
  if (bond && !can_press(s, k)) return {0.0, 0.0};
  const std::size_t c = k - s.bonds.size;
  const double stiff = 0.25 * dt * dt * (bond ? s.bonds.stiffness[k] : s.contacts.stiffness[c]);
  const double dashpot = bond ? bond_dashpot(s.dashpots, s.particles, s.bonds, k, dt)
                              : contact_dashpot(s.dashpots, s.particles, s.contacts, c, dt);
  SpringConstants spring{stiff + 0.5 * dt * dashpot, shear_ratio_at(s, k) * stiff};
  if (bond && s.freedom.cement && bond_state(s.bonds, k) == BondState::intact) {
    const MomentStiffness m = moment_stiffness(stiff, spring.shear, s.bonds.area[k], s.freedom.plane);
    spring.bend = m.bend, spring.twist = m.twist;
  }
  return spring;
}

/// M^-1/2 (dt^2 K/4 + dt C/2) M^-1/2 (1 + alpha) of a scene (B41). One network takes the constants
/// of all steps in turn: it is the largest thing that a run ever holds beside its tables. Masses
/// are counted in their mean, so that floats hold them.
template <class Real>
class ScaledNetwork {
public:
  explicit ScaledNetwork(const StepScene& scene)
      : scene_(scene),
        mean_mass_(std::accumulate(scene.particles.mass.begin(), scene.particles.mass.end(), 0.0) /
                   static_cast<double>(scene.particles.size)),
        network_(elastic_network<Real>(scene.particles, scene.bonds, scene.contacts, scene.freedom.rotation,
                                       scene.threads,
                                       [](std::size_t) {
                                         return SpringConstants{0.0, 0.0};
                                       })),
        by_mass_((std::sqrt(mean_mass_) * roots_of_masses(scene)).template cast<Real>()) {}

  LargestEigenvalue number(double dt, const LanczosEffort& effort) {
    set_constants<Real>(network_, [&](std::size_t k) {
      const auto [normal, shear, bend, twist] = step_constants(scene_, k, dt);
      return SpringConstants{normal / mean_mass_, shear / mean_mass_, bend / mean_mass_, twist / mean_mass_};
    });
    const auto apply = [&](const VectorOf<Real>& x, VectorOf<Real>& image) {
      in_ = static_cast<Real>(1.0 + scene_.global_damping) * by_mass_.cwiseProduct(x);
      apply_stiffness<Real>(network_, in_, loads_, image);
      image = by_mass_.cwiseProduct(image);
    };
    return largest_eigenvalue<Real>(by_mass_.size(), apply, effort, scene_.threads);
  }

private:
  const StepScene& scene_;
  double mean_mass_;  ///< kg
  Network<Real> network_;
  VectorOf<Real> by_mass_, in_;
  std::vector<SpringLoad<Real>> loads_;
};

/// Norms of one spring's part of M^-1 K at both ends.
std::pair<double, double> norms(const StepScene& s, Row lo, Row hi, double length,
                                const SpringConstants& spring) {
  const ParticleTable& p = s.particles;
  const auto of = [&](Row end) {
    const double arm = s.freedom.rotation ? length * p.radius[end] / (p.radius[lo] + p.radius[hi]) : 0.0;
    const double turn = arm * arm / inertia(s.freedom.inertia_factor, p.mass[end], p.radius[end]);
    return std::max(spring.normal / p.mass[end], spring.shear * (1.0 / p.mass[end] + turn));
  };
  return {of(lo), of(hi)};
}

/// A step that is surely below the undamped limit: what the search starts from.
double first_guess(const StepScene& s) {
  std::vector<double> sum(s.particles.size, 0.0);
  const auto each = [&](auto&& visit) {
    for (std::size_t k = 0; k < s.bonds.size; ++k)
      visit(s.bonds.row_lo[k], s.bonds.row_hi[k], s.bonds.rest_length[k], s.bonds.stiffness[k],
            shear_ratio_at(s, k));
    for (std::size_t k = 0; k < s.contacts.size; ++k) {
      const Row lo = s.contacts.row_lo[k], hi = s.contacts.row_hi[k];
      visit(lo, hi, s.particles.radius[lo] + s.particles.radius[hi], s.contacts.stiffness[k],
            shear_ratio_at(s, s.bonds.size + k));
    }
  };
  each([&](Row lo, Row hi, double length, double k_n, double ratio) {
    const auto [at_lo, at_hi] = norms(s, lo, hi, length, {k_n, ratio * k_n});
    sum[lo] += at_lo;
    sum[hi] += at_hi;
  });
  double largest = 0.0;
  each([&](Row lo, Row hi, double, double, double) { largest = std::max(largest, sum[lo] + sum[hi]); });
  return 2.0 / std::sqrt((1.0 + s.global_damping) * largest);
}

struct SearchEffort {
  LanczosEffort lanczos;
  double settled = 0;  ///< distance of the stability number from 1 at which a last secant step may end it
};

/// ln of the number over ln dt is a line of slope 1 (damping) to 2 (stiffness), or less where a
/// scheme holds dashpots back: secants in these logarithms. Two crude values find the neighbourhood
/// and the slope; their start vector is always the same, so that differences mean something long
/// before the values do.
template <class Real>
double step_at_limit(const StepScene& s, const SearchEffort& effort) {
  const double start = first_guess(s);
  if (!std::isfinite(start)) return infinite;
  ScaledNetwork<Real> network(s);
  LanczosEffort crude = effort.lanczos;
  crude.applications = crude.early;
  double x = std::log(start), slope = 1.5;
  std::optional<std::pair<double, double>> before;
  constexpr int turns = 40;
  for (int turn = 0; turn < turns; ++turn) {
    const bool rough = turn < 2;
    const LargestEigenvalue number = network.number(std::exp(x), rough ? crude : effort.lanczos);
    const double early = std::log(number.early);
    if (before && std::abs(x - before->first) > 1e-4)
      slope = std::clamp((early - before->second) / (x - before->first), 0.5, 2.0);
    before = {x, early};
    const double beyond = std::log(number.value);
    x -= beyond / slope;
    if (!rough && std::abs(beyond) < effort.settled) break;
  }
  return std::exp(x);
}

LanczosEffort effort_of_run(std::size_t particles) {
  return {.applications =
              applications_for(static_cast<Eigen::Index>(6 * particles), number_error, number_chance)};
}

}  // namespace

StepEstimate estimate_step(const StepScene& s, double dt, double enough) {
  ScaledNetwork<float> network(s);
  const LanczosEffort effort = effort_of_run(s.particles.size);
  const LargestEigenvalue number = network.number(dt, effort);
  if (number.value <= enough) return {number.value, dt};
  LanczosEffort crude = effort;
  crude.applications = crude.early;
  constexpr double shorter = 0.95;
  const LargestEigenvalue other = network.number(shorter * dt, crude);
  const double slope = std::clamp(std::log(other.early / number.early) / std::log(shorter), 0.5, 2.0);
  return {number.value, dt * std::pow((1.0 - number_error) / number.value, 1.0 / slope)};
}

double stability_number_bound(const StepScene& s, std::span<const std::size_t> contacts, double dt) {
  std::vector<double> sum(s.particles.size, 0.0);
  const ContactTable& c = s.contacts;
  for (const std::size_t k : contacts) {
    const double length = norm(s.particles.position[c.row_hi[k]] - s.particles.position[c.row_lo[k]]);
    const auto [lo, hi] = norms(s, c.row_lo[k], c.row_hi[k], length, step_constants(s, s.bonds.size + k, dt));
    sum[c.row_lo[k]] += lo;
    sum[c.row_hi[k]] += hi;
  }
  double largest = 0.0;
  for (const std::size_t k : contacts) largest = std::max(largest, sum[c.row_lo[k]] + sum[c.row_hi[k]]);
  return (1.0 + s.global_damping) * largest;
}

double critical_time_step(const StepScene& s) {
  return 0.98 * step_at_limit<float>(s, {effort_of_run(s.particles.size), 0.1});  // (B43)
}

double exact_time_step(const StepScene& s) {
  return step_at_limit<double>(s, {{.applications = 4000, .tolerance = 1e-8}, 1e-9});
}

std::vector<double> own_time_steps(const StepScene& s) {
  using Block = Eigen::Matrix<double, 6, 6>;
  const ElasticNetwork net =
      elastic_network(s.particles, s.bonds, s.contacts, s.freedom.rotation, s.threads, [&](std::size_t k) {
        const double k_n = k < s.bonds.size ? s.bonds.stiffness[k] : s.contacts.stiffness[k - s.bonds.size];
        return SpringConstants{k_n, shear_ratio_at(s, k) * k_n};
      });
  const Eigen::VectorXd by_mass = roots_of_masses(s);
  std::vector<double> steps(s.particles.size);
  for_rows(steps.size(), s.threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t row = first; row < last; ++row) {
      Block stiffness = Block::Zero();
      for (std::uint32_t e = net.first_entry[row]; e < net.first_entry[row + 1]; ++e) {
        const auto& spring = net.springs[net.entries[e] >> 1];
        const auto& [normal, arm_ratio] = net.branches[net.entries[e] >> 1];
        const double arm = arm_ratio * net.radius[row];
        const Eigen::Vector3d n(normal.x, normal.y, normal.z);
        const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - n * n.transpose();
        Eigen::Matrix3d turn;  // theta x n
        turn << 0, n.z(), -n.y(), -n.z(), 0, n.x(), n.y(), -n.x(), 0;
        Eigen::Matrix<double, 3, 6> slip;  // at the contact, per displacement and rotation of this end
        slip << across, arm * turn;
        stiffness += spring.k_s * slip.transpose() * slip;
        stiffness.topLeftCorner<3, 3>() += spring.k_n * n * n.transpose();
      }
      const auto roots = by_mass.segment<6>(static_cast<Eigen::Index>(6 * row)).asDiagonal();
      const double largest = largest_eigenvalue(roots * stiffness * roots);
      steps[row] = largest > 0.0 ? 2.0 / std::sqrt(largest) : infinite;  // (P12) (P14)
    }
  });
  return steps;
}

}  // namespace breccia
