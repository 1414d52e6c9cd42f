// The largest stable step against closed forms, the estimate of a run below it, scaled masses, and
// steps that new contacts lower.
#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

#include "core/base/error.hpp"
#include "core/base/largest_eigenvalue.hpp"
#include "core/elastic/elastic_network.hpp"
#include "core/elastic/step_block.hpp"
#include "core/stepping/step.hpp"
#include "core/world/energies.hpp"
#include "core/world/loop_views.hpp"
#include "core/world/make_world.hpp"
#include "tests/scene.hpp"

using namespace breccia;
namespace ref = breccia::reference;
using scene::Ball;

namespace {

constexpr double pi = std::numbers::pi, q = 0.5;

ref::Parameters elastic(double kappa, double xi, double global = 0) {
  ref::Parameters p;
  p.plasticity = p.breakage = false;
  p.kappa = kappa;
  p.xi = xi;
  p.damping_translation = p.damping_rotation = global;
  return p;
}

World world_of(const std::vector<Ball>& balls, const ref::Parameters& p, DampingScheme scheme) {
  WorldOptions o = scene::options(p);
  o.features.rotation = p.rotation;
  o.damping_scheme = scheme;
  return make_world(scene::free_body(balls, p.beta, scene::options(p).features), scene::material_of(p),
                    scene::factor(p), o);
}

/// n touching equal spheres along z.
World chain(std::size_t n, ref::Parameters p, DampingScheme scheme = DampingScheme::explicit_) {
  std::vector<Ball> balls;
  for (std::size_t k = 0; k < n; ++k) balls.push_back({k + 1, 0.01, {0, 0, 0.02 * double(k)}});
  p.beta = 0.01;
  return world_of(balls, p, scheme);
}

/// n^3 of them.
World cube(std::size_t n, ref::Parameters p, DampingScheme scheme) {
  std::vector<Ball> balls;
  for (std::size_t k = 0; k < n * n * n; ++k)
    balls.push_back({k + 1, 0.01, 0.02 * Vec3{double(k % n), double(k / n % n), double(k / (n * n))}});
  p.beta = 0.01;
  return world_of(balls, p, scheme);
}

StepScene scene_of(const World& w) {
  const GlobalDamping& global = w.options.global_damping;
  return {w.particles,
          w.bonds,
          w.contacts,
          w.dashpots,
          w.shear_ratio,
          std::max(global.translation, global.rotation),
          0.0,
          {w.options.features.rotation, false, inertia_factor(w)},
          1};
}

/// Of stiffness s and damping d: s dt^2 + d dt = limit.
double root(double s, double d, double limit) { return 2 * limit / (d + std::sqrt(d * d + 4 * s * limit)); }

/// The limit of a mode with dt^2 K/4 = s dt^2, dt C/2 = d dt for whole dashpots; `cap` is what the
/// cap makes of s, `load` the larger S_i/m_i.
double limit_of(DampingScheme scheme, double s, double d, double cap, double load, double limit) {
  if (scheme == DampingScheme::explicit_) return root(s, d, limit);
  if (scheme == DampingScheme::capped)  // the smaller dashpot allows the larger step
    return std::max(root(s, d, limit), std::sqrt(limit / (s + cap)));
  double low = root(s, d, limit), high = std::sqrt(limit / s);
  for (int k = 0; k < 100; ++k) {
    const double dt = 0.5 * (low + high);
    (s * dt * dt + d * dt / (1 + q * dt * load) < limit ? low : high) = dt;
  }
  return low;
}

constexpr std::array schemes{DampingScheme::explicit_, DampingScheme::capped, DampingScheme::summed};

void check_step(const World& w, double exact) {
  CHECK(std::abs(exact_time_step(scene_of(w)) / exact - 1) < 1e-6);
  CHECK(w.critical_dt < exact);
  CHECK(w.critical_dt > 0.975 * exact);
  CHECK(w.dt == 0.8 * w.critical_dt);
}

}  // namespace

TEST_CASE("time step: undamped chain dt = 2/omega_max, omega_max = 2 sqrt(k/m) cos(pi/(2 n)) [1e-6]") {
  for (const std::size_t n : {2, 3, 10, 40}) {
    const World w = chain(n, elastic(0, 0));
    check_step(
        w, 1 / (std::sqrt(w.bonds.stiffness[0] / w.particles.mass[0]) * std::cos(pi / (2.0 * double(n)))));
  }
  // long fibre (Guo 2013): sqrt(2/3) L sqrt(rho/E)
  const double fibre = std::sqrt(2.0 / 3.0) * 0.02 * std::sqrt(2500 / 28e9);
  CHECK(std::abs(exact_time_step(scene_of(chain(60, elastic(0, 0)))) / fibre - 1) < 1e-3);
}

TEST_CASE("time step: damped pair and chain under each scheme, lambda(dt) = 1/(1 + alpha) [(B41), 1e-6]") {
  for (const DampingScheme scheme : schemes)
    for (const std::size_t n : {2, 3, 12})
      for (const double xi : {0.1, 0.9})
        for (const double global : {0.0, 0.1, 0.3}) {
          INFO(std::string(name_of(scheme)), ", ", n, " spheres, xi ", xi, ", global ", global);
          const World w = chain(n, elastic(0, xi, global), scheme);
          const double m = w.particles.mass[0], k = w.bonds.stiffness[0], c = 2 * xi * std::sqrt(0.5 * m * k);
          const double mode = 4 * std::pow(std::cos(pi / (2.0 * double(n))), 2) / m;  // omega^2 over k
          check_step(w, limit_of(scheme, 0.25 * mode * k, 0.5 * mode * c, 0.5 * mode * q * k,
                                 (n > 2 ? 2 : 1) * c / m, 1 / (1 + global)));
        }
}

TEST_CASE("time step: simple cubic lattice, no rotation: k_n + 2 k_s on the staggered mode [1e-6]") {
  for (const DampingScheme scheme : {DampingScheme::explicit_, DampingScheme::capped}) {
    ref::Parameters p = elastic(0.4, 0.3);
    p.rotation = false;
    const World w = cube(4, p, scheme);
    const double m = w.particles.mass[0], k = w.bonds.stiffness[0], c = 2 * 0.3 * std::sqrt(0.5 * m * k);
    const double mode = 4 * std::pow(std::cos(pi / 8), 2) / m;
    check_step(w,
               limit_of(scheme, 0.25 * mode * k * (1 + 2 * 0.4), 0.5 * mode * c, 0.5 * mode * q * k, 0, 1));
  }
}

TEST_CASE("time step: rolling pair, k_s on slip and both rotations, k_s (2/m + 2 r^2/I) [1e-6]") {
  const World w = chain(2, elastic(2.0, 0));
  check_step(w, 1 / std::sqrt(2.0 * w.bonds.stiffness[0] * 7 / w.particles.mass[0] / 4));
}

TEST_CASE("time step: a light stiff pair apart from 400 others decides [(B43), 1e-6]") {
  std::vector<Ball> balls;
  for (std::size_t k = 0; k < 400; ++k) balls.push_back({k + 1, 0.01, {0, 0, 0.02 * double(k)}});
  balls.push_back({401, 0.0005, {1, 0, 0}});
  balls.push_back({402, 0.0005, {1.001, 0, 0}});
  ref::Parameters p = elastic(0, 0);
  p.beta = 0.01;
  const World w = world_of(balls, p, DampingScheme::explicit_);
  check_step(w, std::sqrt(2 * w.particles.mass[401] / w.bonds.stiffness[w.bonds.size - 1]));
}

TEST_CASE("time step: schemes' dashpots are those of the step, or of the step at which they are held") {
  for (const DampingScheme scheme : schemes) {
    const World w = chain(3, elastic(0.4, 0.9), scheme);
    const double m = w.particles.mass[0], k = w.bonds.stiffness[0], c = 2 * 0.9 * std::sqrt(0.5 * m * k);
    const auto at = [&](double dt) {
      return scheme == DampingScheme::capped   ? std::min(c, q * k * dt)
             : scheme == DampingScheme::summed ? c / (1 + q * dt * 2 * c / m)
                                               : c;
    };
    CHECK(w.bonds.damping[1] == doctest::Approx(at(w.dt)).epsilon(1e-12));
    WorldOptions o = w.options;
    o.damping_step = 3 * w.dt;
    const ref::Parameters p = elastic(0.4, 0.9);
    std::vector<Ball> balls;
    for (std::size_t b = 0; b < 3; ++b) balls.push_back({b + 1, 0.01, {0, 0, 0.02 * double(b)}});
    const World held =
        make_world(scene::free_body(balls, 0.01, o.features), scene::material_of(p), scene::factor(p), o);
    CHECK(held.bonds.damping[1] == doctest::Approx(at(3 * w.dt)).epsilon(1e-12));
    CHECK(std::abs(exact_time_step(scene_of(held)) / root(0.75 * k / m, 1.5 * at(3 * w.dt) / m, 1) - 1) <
          1e-6);
  }
}

TEST_CASE("time step: a packing's estimate lies within 2.5 % below the converged limit, under each scheme") {
  for (const DampingScheme scheme : schemes)
    for (const double xi : {0.0, 0.9}) {
      ref::Parameters p = elastic(0.4, xi, 0.1);
      p.alpha = 0.8;
      WorldOptions o = scene::options(p);
      o.damping_scheme = scheme;
      const Assembly a = assemble(scene::small_packing(500), scene::small_cylinder(), {}, o.features, 1);
      const World w = make_world(a, scene::material_of(p), scene::factor(p), o);
      const double exact = exact_time_step(scene_of(w));
      CHECK(w.critical_dt < exact);
      CHECK(w.critical_dt > 0.975 * exact);
      CHECK(estimate_step(scene_of(w), exact).number == doctest::Approx(1).epsilon(0.02));
      for (const double beyond : {1.02, 1.15}) {
        const StepEstimate look = estimate_step(scene_of(w), beyond * exact);
        CHECK(estimate_step(scene_of(w), beyond * exact, 1.0).critical == look.critical);  // more than enough
        const StepEstimate enough = estimate_step(scene_of(w), beyond * exact, 1.5);
        CHECK(enough.number == look.number);
        CHECK(enough.critical == beyond * exact);
        CHECK(look.critical < exact * 1.003);
        CHECK(look.critical > 0.97 * exact);
      }
    }
}

TEST_CASE("time step: a safety beyond 1 is refused") {
  const ref::Parameters p = elastic(0, 0);
  WorldOptions o = scene::options(p);
  o.safety = 1.01;
  const Assembly a = scene::free_body({{1, 0.01, {}}, {2, 0.01, {0, 0, 0.02}}}, 0.1, o.features);
  CHECK_THROWS_AS(make_world(a, scene::material_of(p), scene::factor(p), o), BadInput);
}

TEST_CASE(
    "mass scaling: the lightest for their stiffness up to the total asked for, inertia and c_n with them") {
  ref::Parameters p = elastic(0.4, 0.9);
  p.alpha = 0.8;
  WorldOptions o = scene::options(p);
  const Assembly a = assemble(scene::small_packing(500), scene::small_cylinder(), {}, o.features, 1);
  const World plain = make_world(a, scene::material_of(p), scene::factor(p), o);
  o.mass_factor = 1.5;
  const World w = make_world(a, scene::material_of(p), scene::factor(p), o);
  const std::vector<double> before = own_time_steps(scene_of(plain)), after = own_time_steps(scene_of(w));
  double mass = 0, true_mass = 0;
  std::size_t scaled = 0;
  const double target = *std::ranges::min_element(after);
  for (std::size_t k = 0; k < w.particles.size; ++k) {
    const double scale = w.particles.mass[k] / plain.particles.mass[k];
    mass += w.particles.mass[k];
    true_mass += plain.particles.mass[k];
    scaled += scale > 1;
    CHECK(scale == doctest::Approx(std::max(1.0, std::pow(target / before[k], 2))).epsilon(1e-9));
  }
  CHECK(mass / true_mass == doctest::Approx(1.5).epsilon(1e-9));
  CHECK(mass <= 1.5 * true_mass * (1 + 1e-12));
  CHECK(w.mass_scaling.factor == doctest::Approx(1.5).epsilon(1e-9));
  CHECK(w.mass_scaling.scaled == scaled);
  CHECK((scaled > 100 && scaled < w.particles.size));
  CHECK(plain.mass_scaling.scaled == 0);
  CHECK(w.critical_dt > 1.2 * plain.critical_dt);
  const double lo = w.particles.mass[w.bonds.row_lo[7]], hi = w.particles.mass[w.bonds.row_hi[7]];
  CHECK(w.bonds.damping[7] ==
        doctest::Approx(2 * 0.9 * std::sqrt(lo * hi / (lo + hi) * w.bonds.stiffness[7])).epsilon(1e-12));
}

TEST_CASE(
    "time step: around new contacts its number is that of the whole where they decide, and never larger [2 "
    "%]") {
  // a light sphere beside a cube of heavy ones decides; one that is as heavy does not
  for (const double radius : {0.002, 0.01}) {
    ref::Parameters p = elastic(0.4, 0.9);
    p.beta = 0.01;
    std::vector<Ball> balls;
    for (std::size_t k = 0; k < 125; ++k)
      balls.push_back({k + 1, 0.01, 0.02 * Vec3{double(k % 5), double(k / 5 % 5), double(k / 25)}});
    balls.push_back({126, radius, {0.04, 0.04, 0.09 + radius + 0.0005}, 0, {0, 0, -10}});
    WorldOptions o = scene::options(p);
    Assembly a = scene::free_body(balls, p.beta, o.features);
    a.mean_radius = 0.01;
    World w = make_world(a, scene::material_of(p), scene::factor(p), o);
    while (w.contacts.size == 0 && w.step < 1000) advance(w);
    REQUIRE(w.contacts.size > 0);
    std::vector<std::size_t> all(w.contacts.size);
    std::iota(all.begin(), all.end(), std::size_t{0});
    const StepScene whole = scene_of(w);
    const double of_all = estimate_step(whole, w.dt).number;
    double before = 0;
    for (const int bonds : {0, 1, 2, 3, 20}) {
      const StepBlock block = block_around(whole, all, bonds);
      const double number = estimate_step(block.scene(whole), w.dt).number;
      CHECK(number <= 1.02 * of_all);
      CHECK(number >= 0.98 * before);  // a larger principal block
      before = number;
      if (bonds == 3 && radius < 0.01) CHECK(number == doctest::Approx(of_all).epsilon(0.02));
      if (bonds == 20) CHECK(std::ranges::count(block.fixed, 1) == 0);
      if (bonds == 20) CHECK(number == doctest::Approx(of_all).epsilon(0.02));
      if (bonds == 1) CHECK(std::ranges::count(block.fixed, 1) > 0);
    }
  }
}

TEST_CASE("time step: small spheres that come near lower it, dashpots follow, and it is never raised") {
  for (const DampingScheme scheme : schemes) {
    ref::Parameters p = elastic(0.4, 0.9);
    std::vector<Ball> balls{{1, 0.01, {0, 0, 0}}, {2, 0.01, {0, 0, 0.02}}};
    for (Gid k = 0; k < 4; ++k) {  // fly towards the first sphere
      const Vec3 outward{std::cos(0.35 * double(k)), std::sin(0.35 * double(k)), 0};
      balls.push_back({k + 3, 0.0015, 0.0119 * outward, 0, -10.0 * outward});
    }
    WorldOptions o = scene::options(p);
    o.damping_scheme = scheme;
    Assembly a = scene::free_body(balls, 0.1, o.features);
    a.mean_radius = 0.005;
    World w = make_world(a, scene::material_of(p), scene::factor(p), o);
    const double first = w.dt;
    CHECK(first == 0.8 * w.critical_dt);
    double most = 0, lowest = first;
    bool touched = false;
    for (int k = 0; k < 4000; ++k) {
      advance(w);
      CHECK_MESSAGE(w.dt <= lowest, "raised at step ", k);
      if (w.dt < lowest) CHECK(w.dt <= 1.01 * o.safety * exact_time_step(scene_of(w)));
      lowest = w.dt;
      most = std::max(most, kinetic_energy(w));
      touched = touched || dot(w.particles.velocity[2], w.particles.position[2]) > 0;
    }
    CHECK(touched);
    CHECK(w.dt < 0.6 * first);
    CHECK(w.step_monitor.looks >= 1);
    CHECK(w.step_monitor.first_dt == first);
    CHECK(most < 1.01 * 0.5 * 4 * w.particles.mass[2] * 100);  // nobody is faster than they came
    const double c = bond_dashpot(w.dashpots, w.particles, w.bonds, 0, w.dt);
    CHECK(w.bonds.damping[0] == c);
    CHECK((scheme == DampingScheme::explicit_ ||
           c != bond_dashpot(w.dashpots, w.particles, w.bonds, 0, first)));
  }
}

TEST_CASE("time step: what contacts add to the stability number stays below its bound by norms") {
  ref::Parameters p = elastic(0.4, 0.9);
  p.alpha = 0.8;
  WorldOptions o = scene::options(p);
  const Assembly a = assemble(scene::small_packing(200), scene::small_cylinder(), {}, o.features, 1);
  World w = make_world(a, scene::material_of(p), scene::factor(p), o);
  const double without = estimate_step(scene_of(w), w.dt).number;
  w.neighbour_list.skin *= 5;  // many at once
  rebuild_neighbour_list(
      w.neighbour_list, w.contacts, w.particles,
      {w.contact_young, w.contact_poisson, w.shear_ratio, 1, w.alpha, Space::three_d, contact_columns(w)}, 1);
  REQUIRE(w.contacts.size > 20);
  std::vector<std::size_t> all(w.contacts.size);
  std::iota(all.begin(), all.end(), std::size_t{0});
  const double with = estimate_step(scene_of(w), w.dt).number,
               bound = stability_number_bound(scene_of(w), all, w.dt);
  CHECK(with >= without * (1 - 1e-9));
  CHECK(with <= (without + bound) * 1.02);
  CHECK(bound > 0);
}

TEST_CASE(
    "largest eigenvalue: of a diagonal with one entry above a crowd [1e-9], applications by the theorem") {
  const Eigen::Index n = 5000;
  Eigen::VectorXd d = Eigen::VectorXd::LinSpaced(n, 0, 1);
  d[1234] = 1.05;
  const auto apply = [&](const Eigen::VectorXd& x, Eigen::VectorXd& y) { y = d.cwiseProduct(x); };
  CHECK(largest_eigenvalue<double>(n, apply, {.applications = 2000, .tolerance = 1e-7}, 1).value ==
        doctest::Approx(1.05).epsilon(1e-9));
  const LargestEigenvalue few =
      largest_eigenvalue<double>(n, apply, {.applications = applications_for(n, 0.02, 1e-3)}, 1);
  CHECK(few.value > 0.98 * 1.05);
  CHECK(few.value < 1.05 * (1 + 1e-12));
  CHECK(few.early < few.value);
  CHECK(few.applications == applications_for(n, 0.02, 1e-3));
  // in floats, as estimates in a run are
  const auto apply_floats = [&](const Eigen::VectorXf& x, Eigen::VectorXf& y) {
    y = d.cast<float>().cwiseProduct(x);
  };
  const LargestEigenvalue rough =
      largest_eigenvalue<float>(n, apply_floats, {.applications = applications_for(n, 0.02, 1e-3)}, 1);
  CHECK(rough.value == doctest::Approx(few.value).epsilon(1e-5));
  CHECK(rough.early == doctest::Approx(few.early).epsilon(1e-5));
}
