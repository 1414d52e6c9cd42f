// The largest stable step: closed forms, the proven bound below it, and runs just under and over it.
#include <doctest/doctest.h>

#include <random>

#include "core/time_step.hpp"
#include "tests/scene.hpp"

using namespace breccia;
namespace ref = breccia::reference;
using scene::Ball;

namespace {

constexpr double pi = std::numbers::pi,
                 less = 0.98;  // the estimate is given less 2 % for its error from below

/// n touching equal spheres along z.
World chain(std::size_t n, ref::Parameters p, double global = 0) {
  std::vector<Ball> balls;
  for (std::size_t k = 0; k < n; ++k) balls.push_back({k + 1, 0.01, {0, 0, 0.02 * double(k)}});
  p.beta = 0.01;
  p.damping_translation = p.damping_rotation = global;
  return make_world(scene::free_body(balls, p.beta, scene::options(p).features), scene::material_of(p),
                    scene::factor(p), scene::options(p));
}

double estimate(const World& w, double damping = 0) {
  return critical_time_step(w.particles, w.bonds, w.shear_ratio, {}, damping, 1);
}
double proven(const World& w, double damping = 0) {
  return proven_time_step(w.particles, w.bonds, w.shear_ratio, {}, damping, 1);
}

ref::Parameters elastic(double kappa, double xi) {
  ref::Parameters p;
  p.plasticity = p.breakage = false;
  p.kappa = kappa;
  p.xi = xi;
  return p;
}

struct Packing {
  World world;
  double limit;
};
Packing packing(double xi, double global) {
  ref::Parameters p = elastic(0.4, xi);
  p.alpha = 0.8;
  p.unbonded_contacts = false;
  p.damping_translation = p.damping_rotation = global;
  const Assembly a =
      assemble(scene::small_packing(200), scene::small_cylinder(), {}, scene::options(p).features, 1);
  World w = make_world(a, scene::material_of(p), scene::factor(p), scene::options(p));
  // nobody held: every particle is free in the estimate
  w.particles.free = w.first_top = w.particles.size;
  return {w, estimate(w, global) / less};
}

/// Largest kinetic energy of the last tenth of a run over that of its start; infinite where a number is lost.
double growth(World w, double dt, int steps) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> in(-1, 1);
  for (Vec3& v : w.particles.velocity) v = 1e-6 * Vec3{in(random), in(random), in(random)};
  for (Vec3& s : w.particles.spin) s = 1e-4 * Vec3{in(random), in(random), in(random)};
  w.dt = dt;
  const double first = kinetic_energy(w);
  double last = 0;
  for (int k = 0; k < steps; ++k) {
    advance(w);
    if (k <= steps * 9 / 10) continue;
    const double now = kinetic_energy(w);
    if (!std::isfinite(now)) return std::numeric_limits<double>::infinity();
    last = std::max(last, now);
  }
  return last / first;
}

}  // namespace

TEST_CASE(
    "time step: undamped chain dt = 2/omega_max, omega_max = 2 sqrt(k/m) cos(pi/(2 n)) "
    "[verification_formulas, 1e-3]") {
  for (const std::size_t n : {2, 3, 10, 40}) {
    const World w = chain(n, elastic(0, 0));
    const double exact =
        1 / (std::sqrt(w.bonds.stiffness[0] / w.particles.mass[0]) * std::cos(pi / (2.0 * double(n))));
    CHECK(estimate(w) == doctest::Approx(less * exact).epsilon(2e-3));
    CHECK(estimate(w) < exact);
    CHECK(proven(w) <= exact * (1 + 1e-12));
  }
  // long fibre (Guo 2013): sqrt(2/3) L sqrt(rho/E)
  const World w = chain(60, elastic(0, 0));
  CHECK(estimate(w) / less ==
        doctest::Approx(std::sqrt(2.0 / 3.0) * 0.02 * std::sqrt(2500 / 28e9)).epsilon(3e-3));
}

TEST_CASE("time step: damped pair, dt^2 k/(4 m_ij) + dt c/(2 m_ij) = 1/(1 + alpha) [MODEL 8, 1e-3]") {
  for (const double xi : {0.0, 0.1, 0.9})
    for (const double global : {0.0, 0.1, 0.3}) {
      const World w = chain(2, elastic(0, xi), global);
      const double m_ij = 0.5 * w.particles.mass[0], k = w.bonds.stiffness[0],
                   c = w.bonds.damping.empty() ? 0 : w.bonds.damping[0];
      CHECK(c == doctest::Approx(2 * xi * std::sqrt(m_ij * k)).epsilon(1e-12));
      const double omega = std::sqrt(k / m_ij), limit = 1 / (1 + global);
      const double exact =
          2 / omega * (std::sqrt(xi * xi + limit) - xi);  // of (omega dt/2)^2 + xi omega dt = limit
      CHECK(estimate(w, global) == doctest::Approx(less * exact).epsilon(1e-3));
      CHECK(w.critical_dt == estimate(w, global));
      CHECK(proven(w, global) <= exact * (1 + 1e-12));
      CHECK(proven(w, global) > 0.5 * exact);
    }
}

TEST_CASE("time step: rolling pair, k_s on slip and both rotations [eigenvalue in closed form, 1e-3]") {
  // antisymmetric slip: mass m/2 and two spheres that roll: lambda = dt^2/4 k_s (2/m + 2 r^2/I) = dt^2/4 k_s
  // 7/m
  const World w = chain(2, elastic(2.0, 0));
  const double lambda = 2.0 * w.bonds.stiffness[0] * 7 / w.particles.mass[0] / 4;
  REQUIRE(lambda > w.bonds.stiffness[0] * 2 / w.particles.mass[0] / 4);
  CHECK(estimate(w) == doctest::Approx(less / std::sqrt(lambda)).epsilon(1e-3));
  CHECK(proven(w) <= 1 / std::sqrt(lambda) * (1 + 1e-12));
}

TEST_CASE(
    "time step: 200 spheres are bounded at 0.97 of the limit and blow up at 1.1, damped or not, proven bound "
    "below [MODEL 8]") {
  for (const auto& [xi, global] : {std::pair{0.0, 0.0}, {0.9, 0.0}, {0.9, 0.1}}) {
    const auto [w, limit] = packing(xi, global);
    INFO("xi ", xi, ", global ", global, ", limit ", limit, ", proven ", proven(w, global));
    CHECK(proven(w, global) <= limit);
    CHECK(proven(w, global) > 0.6 * limit);
    const double kept = growth(w, 0.97 * limit, 4000);
    CHECK(kept < 30);
    CHECK((xi > 0 || kept > 0.05));
    // with global damping the limit is asked for, not sharp
    CHECK(growth(w, (global > 0 ? 1.3 : 1.1) * limit, 1500) > 1e6);
  }
}
