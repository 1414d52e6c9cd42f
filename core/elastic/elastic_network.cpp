#include "core/elastic/elastic_network.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/threads.hpp"
#include "core/elastic/gauges.hpp"
#include "core/tables/laws.hpp"

namespace breccia {
namespace {

template <class Real>
Vec<Real> three(const VectorOf<Real>& v, std::size_t at) {
  const auto k = static_cast<Eigen::Index>(at);
  return {v[k], v[k + 1], v[k + 2]};
}
template <class Real>
void put(VectorOf<Real>& v, std::size_t at, const Vec<Real>& f) {
  const auto k = static_cast<Eigen::Index>(at);
  v[k] = f.x, v[k + 1] = f.y, v[k + 2] = f.z;
}

template <class Real>
SpringLoad<Real> load_of(const Network<Real>& net, std::size_t k, const VectorOf<Real>& u) {
  const auto& [lo, hi, k_n, k_s] = net.springs[k];
  const auto& [normal, arm_ratio] = net.branches[k];
  const std::size_t at_lo = 6 * std::size_t{lo}, at_hi = 6 * std::size_t{hi};
  const Vec<Real> turn =
      arm_ratio * (net.radius[lo] * three<Real>(u, at_lo + 3) + net.radius[hi] * three<Real>(u, at_hi + 3));
  const Vec<Real> relative = three<Real>(u, at_hi) - three<Real>(u, at_lo) - cross(turn, normal);
  const Vec<Real> pull = (k_n - k_s) * dot(relative, normal) * normal + k_s * relative;
  return {pull, arm_ratio * cross(normal, pull)};
}

/// Couple on the lower end. (B123)
template <class Real>
Vec<Real> couple_of(const Network<Real>& net, std::size_t k, const VectorOf<Real>& u) {
  const Vec<Real>& n = net.branches[k].normal;
  const Vec<Real> turn = three<Real>(u, 6 * std::size_t{net.springs[k].hi} + 3) -
                         three<Real>(u, 6 * std::size_t{net.springs[k].lo} + 3);
  const auto& [bend, twist] = net.turnings[k];
  return bend * turn + ((twist - bend) * dot(turn, n)) * n;
}

/// Moments are rare: there is room for them where one is asked for.
template <class Real>
void set_turning(Network<Real>& net, std::size_t k, const SpringConstants& c) {
  if (net.turnings.empty() && c.bend == 0.0 && c.twist == 0.0) return;
  if (net.turnings.empty()) net.turnings.assign(net.springs.size(), {Real(0), Real(0)});
  net.turnings[k] = {static_cast<Real>(c.bend), static_cast<Real>(c.twist)};
}

}  // namespace

template <class Real>
Network<Real> elastic_network(const ParticleTable& p, const BondTable& b, const ContactTable& c,
                              bool rotation, int threads,
                              const std::function<SpringConstants(std::size_t)>& constants) {
  const auto real = [](double x) { return static_cast<Real>(x); };
  Network<Real> net;
  net.particles = p.size;
  net.threads = threads;
  for (const double radius : p.radius) net.radius.push_back(real(radius));
  net.springs.resize(b.size + c.size);
  net.branches.resize(net.springs.size());
  net.first_entry.assign(net.particles + 1, 0);
  for (std::size_t k = 0; k < net.springs.size(); ++k) {
    const bool bond = k < b.size;
    const Row lo = bond ? b.row_lo[k] : c.row_lo[k - b.size], hi = bond ? b.row_hi[k] : c.row_hi[k - b.size];
    const Vec3 l = p.position[hi] - p.position[lo];
    const double distance = norm(l), length = bond ? b.rest_length[k] : distance;
    const SpringConstants spring = constants(k);
    const double arm_ratio = rotation ? length / (p.radius[lo] + p.radius[hi]) : 0.0;
    net.springs[k] = {lo, hi, real(spring.normal), real(spring.shear)};
    if (rotation) set_turning(net, k, spring);
    net.branches[k] = {{real(l.x / distance), real(l.y / distance), real(l.z / distance)}, real(arm_ratio)};
    ++net.first_entry[lo + 1];
    ++net.first_entry[hi + 1];
  }
  for (std::size_t k = 0; k < net.particles; ++k) net.first_entry[k + 1] += net.first_entry[k];
  net.entries.resize(2 * net.springs.size());
  std::vector<std::uint32_t> next(net.first_entry.begin(), net.first_entry.end() - 1);
  for (std::size_t k = 0; k < net.springs.size(); ++k) {
    net.entries[next[net.springs[k].lo]++] = static_cast<std::uint32_t>(k << 1);
    net.entries[next[net.springs[k].hi]++] = static_cast<std::uint32_t>(k << 1 | 1u);
  }
  return net;
}

template <class Real>
void set_constants(Network<Real>& net, const std::function<SpringConstants(std::size_t)>& constants) {
  for (std::size_t k = 0; k < net.springs.size(); ++k) {
    const SpringConstants spring = constants(k);
    net.springs[k].k_n = static_cast<Real>(spring.normal);
    net.springs[k].k_s = static_cast<Real>(spring.shear);
    set_turning(net, k, spring);
  }
}

template <class Real>
void apply_stiffness(const Network<Real>& net, const VectorOf<Real>& u, std::vector<SpringLoad<Real>>& loads,
                     VectorOf<Real>& forces) {
  loads.resize(net.springs.size());
  for_rows(net.springs.size(), net.threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) loads[k] = load_of(net, k, u);
  });
  for_rows(net.particles, net.threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t p = first; p < last; ++p) {
      Vec<Real> force, moment, couple;
      for (std::uint32_t e = net.first_entry[p]; e < net.first_entry[p + 1]; ++e) {
        const SpringLoad<Real>& load = loads[net.entries[e] >> 1];
        // K u is what must be applied: minus the spring's pull on the end
        force += (net.entries[e] & 1u ? Real(1) : Real(-1)) * load.pull;
        moment += load.moment;
        if (!net.turnings.empty())
          couple += (net.entries[e] & 1u ? Real(1) : Real(-1)) * couple_of(net, net.entries[e] >> 1, u);
      }
      put<Real>(forces, 6 * p, force);
      put<Real>(forces, 6 * p + 3, couple - net.radius[p] * moment);
    }
  });
}

#define BRECCIA_NETWORK_OF(Real)                                                                             \
  template Network<Real> elastic_network(const ParticleTable&, const BondTable&, const ContactTable&, bool,  \
                                         int, const std::function<SpringConstants(std::size_t)>&);           \
  template void set_constants(Network<Real>&, const std::function<SpringConstants(std::size_t)>&);           \
  template void apply_stiffness(const Network<Real>&, const VectorOf<Real>&, std::vector<SpringLoad<Real>>&, \
                                VectorOf<Real>&);
BRECCIA_NETWORK_OF(double)
BRECCIA_NETWORK_OF(float)

namespace {

/// Diagonal of K, for the preconditioner.
Eigen::VectorXd stiffness_diagonal(const ElasticNetwork& net) {
  Eigen::VectorXd d = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(6 * net.particles));
  for (std::size_t spring = 0; spring < net.springs.size(); ++spring) {
    const auto& s = net.springs[spring];
    const auto& [normal, arm_ratio] = net.branches[spring];
    const Vec3 n2{normal.x * normal.x, normal.y * normal.y, normal.z * normal.z};
    for (const bool hi : {false, true}) {
      const auto at = static_cast<Eigen::Index>(6 * (hi ? s.hi : s.lo));
      const double arm = arm_ratio * net.radius[hi ? s.hi : s.lo];
      const double squares[3] = {n2.x, n2.y, n2.z};
      for (int k = 0; k < 3; ++k) {
        d[at + k] += s.k_n * squares[k] + s.k_s * (1.0 - squares[k]);
        d[at + 3 + k] += s.k_s * arm * arm * (1.0 - squares[k]);
        if (net.turnings.empty()) continue;
        const auto& [bend, twist] = net.turnings[spring];
        d[at + 3 + k] += bend * (1.0 - squares[k]) + twist * squares[k];
      }
    }
  }
  return d;
}

}  // namespace

std::vector<double> bond_stiffness(std::span<const BondLaw> laws, const ParticleTable& p,
                                   const BondTable& b) {
  std::vector<double> k_n(b.size);
  with_laws(laws, b.law, [&](const auto& law_of) {
    for (std::size_t k = 0; k < b.size; ++k)
      k_n[k] =
          stiffness_of(law_of(k), b.area[k],
                       strain_length_of(b.rest_length[k], p.radius[b.row_lo[k]] + p.radius[b.row_hi[k]]));
  });
  return k_n;
}

namespace {

/// Conjugate gradients on the free unknowns, preconditioned by the diagonal; a prescribed unknown
/// has a zero there.
/// @param u  prescribed values, and a first guess of the others
/// @returns turns, `limit` where that was not enough
long solve(const ElasticNetwork& net, const Eigen::VectorXd& inverse_diagonal, Eigen::VectorXd& u,
           long limit) {
  const auto free = (inverse_diagonal.array() > 0.0).cast<double>().matrix().eval();
  const Eigen::Index n = u.size();
  Eigen::VectorXd force(n), residual(n), direction(n), image(n);
  std::vector<SpringLoad<double>> loads;
  apply_stiffness(net, u, loads, force);
  residual = -force.cwiseProduct(free);
  Eigen::VectorXd z = residual.cwiseProduct(inverse_diagonal);
  direction = z;
  double rho = residual.dot(z);
  const double start = force.cwiseAbs().maxCoeff();
  long turns = 0;
  while (residual.cwiseAbs().maxCoeff() > 1e-7 * start && turns < limit) {
    apply_stiffness(net, direction, loads, image);
    const double step = rho / direction.dot(image);
    u += step * direction;
    residual -= step * image.cwiseProduct(free);
    z = residual.cwiseProduct(inverse_diagonal);
    const double next = residual.dot(z);
    direction = z + (next / rho) * direction;
    rho = next;
    ++turns;
  }
  return turns;
}

/// What is prescribed, and zero where nothing holds a particle.
void set_free(const Assembly& a, bool rough, Eigen::VectorXd& inverse_diagonal) {
  inverse_diagonal = (inverse_diagonal.array() > 0.0).select(inverse_diagonal.cwiseInverse(), 0.0);
  for (std::size_t row = a.particles.free; row < a.particles.size; ++row) {
    const auto at = static_cast<Eigen::Index>(6 * row);
    inverse_diagonal[at + 2] = 0.0;  // prescribed: neither moved nor balanced
    if (rough) inverse_diagonal[at] = inverse_diagonal[at + 1] = 0.0;
  }
  if (a.space == Space::two_d)
    for (Eigen::Index at = 0; at < inverse_diagonal.size(); at += 6)
      inverse_diagonal[at + 1] = inverse_diagonal[at + 3] = inverse_diagonal[at + 5] = 0.0;
}

/// A contact between surfaces presses or is open, and holds or slides: what it answers to these
/// displacements, as a secant.
SpringConstants pressed(const ElasticNetwork& net, std::size_t spring, const Eigen::VectorXd& u,
                        double stiffness, double shear_ratio, double friction) {
  const auto& [normal, arm_ratio] = net.branches[spring];
  const std::size_t at_lo = 6 * std::size_t{net.springs[spring].lo},
                    at_hi = 6 * std::size_t{net.springs[spring].hi};
  const Vec3 turn = arm_ratio * (net.radius[net.springs[spring].lo] * three<double>(u, at_lo + 3) +
                                 net.radius[net.springs[spring].hi] * three<double>(u, at_hi + 3));
  const Vec3 relative = three<double>(u, at_hi) - three<double>(u, at_lo) - cross(turn, normal);
  const double nearer = -dot(relative, normal);
  if (!(nearer > 0.0)) return {0.0, 0.0};
  const double along = norm(relative + nearer * normal), held = friction * nearer;
  const double shear = shear_ratio * along > held ? held / along : shear_ratio;
  return {stiffness, shear * stiffness};
}

}  // namespace

ElasticResponse probe(const Assembly& a, std::span<const double> stiffness,
                      std::span<const double> shear_ratio, bool rough, int threads,
                      const Touching& touching) {
  const ParticleTable& p = a.particles;
  const Gauge axial_strain = axial_gauge(a), lateral_strain = lateral_gauge(a);
  if (axial_strain.rows.empty())
    fail<BadInput>(
        "bonds.alpha: no two spheres that hang together lie in the middle half of the height; check "
        "specimen.height, or give alpha a number");
  const ContactTable& c = touching.contacts;
  std::vector<SpringConstants> contact(c.size);
  const auto constants = [&](std::size_t k) {
    if (k >= a.bonds.size) return contact[k - a.bonds.size];
    SpringConstants spring{stiffness[k], of_law(shear_ratio, a.bonds.law, k) * stiffness[k]};
    if (a.cement) {
      const MomentStiffness m =
          moment_stiffness(spring.normal, spring.shear, a.bonds.area[k], a.space == Space::two_d);
      spring.bend = m.bend, spring.twist = m.twist;
    }
    return spring;
  };
  ElasticNetwork net = elastic_network(p, a.bonds, c, a.rotation, threads, constants);
  const auto n = static_cast<Eigen::Index>(6 * net.particles);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(n), force(n);
  const double push = 0.5e-4 * a.body.height;  // any size: the answer is linear
  // the affine field is a good first guess
  for (std::size_t row = 0; row < net.particles; ++row)
    u[static_cast<Eigen::Index>(6 * row + 2)] =
        row < p.free ? -2.0 * push / a.body.height * p.reference_position[row].z
                     : (row < a.first_top ? push : -push);
  const auto strain = [&](const Gauge& g) {
    double sum = 0.0;
    for (std::size_t k = 0; k < g.rows.size(); ++k)
      sum += dot(g.weights[k], three<double>(u, 6 * std::size_t{g.rows[k]}));
    return sum;
  };
  ElasticResponse answer;
  std::vector<SpringLoad<double>> loads;
  constexpr int most_turns = 30;  // until contacts are open, hold or slide as their forces have it
  for (int turn = 0; turn < most_turns; ++turn) {
    for (std::size_t k = 0; k < c.size; ++k) {
      const SpringConstants now =
          pressed(net, a.bonds.size + k, u, c.stiffness[k], of_law(shear_ratio, c.law, k), touching.friction);
      // half of the way: what opens in one turn would be pressed again in the next
      const double part = turn == 0 ? 1.0 : 0.5;
      contact[k].normal += part * (now.normal - contact[k].normal);
      contact[k].shear += part * (now.shear - contact[k].shear);
    }
    if (c.size > 0) set_constants<double>(net, constants);
    Eigen::VectorXd inverse_diagonal = stiffness_diagonal(net);
    set_free(a, rough, inverse_diagonal);
    constexpr long limit = 20000;
    const long turns = solve(net, inverse_diagonal, u, limit);
    if (turns == limit)
      fail<BadInput>("bonds.alpha: the elastic probe did not converge; give alpha a number or \"affine\"");
    answer.iterations += turns;
    apply_stiffness(net, u, loads, force);
    double reaction = 0.0;
    for (std::size_t row = p.free; row < net.particles; ++row)
      reaction += (row < a.first_top ? 0.5 : -0.5) * force[static_cast<Eigen::Index>(6 * row + 2)];
    const double before = answer.young_modulus;
    const double axial = strain(axial_strain), radial = strain(lateral_strain);
    answer.young_modulus = reaction / a.section() / axial;
    answer.poisson_ratio = -radial / axial;
    if (c.size == 0 || std::abs(answer.young_modulus - before) < 3e-3 * std::abs(before)) break;
  }
  const double scale = *std::max_element(stiffness.begin(), stiffness.end()) / a.mean_radius;
  if (!(answer.young_modulus > 1e-6 * scale))
    fail<BadInput>("bonds.range: the bonds do not connect the two ends of the specimen; widen the range");
  return answer;
}

}  // namespace breccia
