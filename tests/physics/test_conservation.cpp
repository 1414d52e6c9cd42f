// What must stay the same whatever happens, and what has a closed form: the fast code.
#include <doctest/doctest.h>

#include <random>

#include "core/stepping/step.hpp"
#include "core/world/energies.hpp"
#include "core/world/energy_accounting.hpp"
#include "core/world/loop_views.hpp"
#include "core/world/make_world.hpp"
#include "tests/scene.hpp"

using namespace breccia;
namespace ref = breccia::reference;
using scene::Ball;

namespace {

constexpr double pi = std::numbers::pi;

World world_of(const std::vector<Ball>& balls, const ref::Parameters& p, WorldOptions o) {
  return make_world(scene::free_body(balls, p.beta, o.features), scene::material_of(p), scene::factor(p), o);
}
World world_of(const std::vector<Ball>& balls, const ref::Parameters& p) {
  return world_of(balls, p, scene::options(p));
}

/// A cluster of 36 that breaks up: the scene that the reference conserves momenta in.
std::vector<Ball> colliding_cluster() {
  std::mt19937 random(20240601);
  std::uniform_real_distribution<double> in(-1, 1);
  const auto noise = [&](double size) { return size * Vec3{in(random), in(random), in(random)}; };
  std::vector<Ball> balls;
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 3; ++y)
      for (int z = 0; z < 3; ++z) {
        Ball b{40 - balls.size(), 0.05 + 0.005 * in(random), Vec3{0.1 * x, 0.1 * y, 0.1 * z} + noise(0.004),
               x < 3 ? 1 : 2};
        b.v = noise(6) + (x < 2 ? Vec3{4, 0, 0} : Vec3{-4, 0, 0});
        b.w = noise(60);
        balls.push_back(b);
      }
  return balls;
}

ref::Parameters brittle() {
  ref::Parameters p;
  p.E = 1e9;
  p.LCS = {5e6, 8e6, 10e6};
  p.sigma_t = 2e6;
  p.tau_f = 4e6;
  p.xi = 0.2;
  return p;
}

std::pair<Vec3, Vec3> momenta(const World& w) {
  Vec3 P, L;
  const ParticleTable& p = w.particles;
  for (std::size_t k = 0; k < p.size; ++k) {
    P += p.mass[k] * p.velocity[k];
    L += p.mass[k] * cross(p.position[k], p.velocity[k]) +
         inertia(sphere_inertia_factor, p.mass[k], p.radius[k]) * p.spin[k];
  }
  return {P, L};
}

/// Equal touching spheres along z.
std::vector<Ball> chain(std::size_t n) {
  std::vector<Ball> balls;
  for (std::size_t k = 0; k < n; ++k) balls.push_back({k + 1, 0.01, {0, 0, 0.02 * double(k)}});
  return balls;
}

ref::Parameters elastic_chain() {
  ref::Parameters p;
  p.plasticity = p.breakage = false;
  p.xi = 0;
  p.kappa = 0;
  p.beta = 0.01;
  p.unbonded_contacts = false;
  return p;
}

}  // namespace

TEST_CASE(
    "conservation: momentum and angular momentum of a breaking cluster [(P18), round-off: 1e-13 of sum "
    "m|v|]") {
  for (const auto criterion :
       {ref::Criterion::uncoupled, ref::Criterion::coupled, ref::Criterion::mohr_coulomb})
    for (const auto& [scatter, threads] : {std::pair{ScatterKind::private_sums, 1},
                                           {ScatterKind::private_sums, 2},
                                           {ScatterKind::atomic, 2},
                                           {ScatterKind::gather, 2}}) {
      ref::Parameters p = brittle();
      p.criterion = criterion;
      WorldOptions o = scene::options(p);
      o.scatter = scatter, o.threads = threads;
      World w = world_of(colliding_cluster(), p, o);
      REQUIRE(w.bonds.size > 50);
      REQUIRE(w.dt > 2e-6);
      w.dt = 2e-6;
      double size = 0;
      for (std::size_t k = 0; k < w.particles.size; ++k)
        size += w.particles.mass[k] * norm(w.particles.velocity[k]);
      const auto [P0, L0] = momenta(w);
      bool touched = false;
      for (int k = 0; k < 1500; ++k) {
        advance(w);
        touched =
            touched || std::ranges::any_of(w.contacts.shear_force, [](const Vec3& f) { return norm(f) > 0; });
      }
      const auto [P, L] = momenta(w);
      INFO("criterion ", int(criterion), ", scatter ", int(scatter), ", threads ", threads);
      CHECK(norm(P - P0) < 1e-13 * size);
      CHECK(norm(L - L0) < 1e-13 * size * 0.5);
      CHECK(count_broken(w).tension > 0);
      CHECK(count_broken(w).shear > 0);
      CHECK(touched);
      CHECK(std::ranges::any_of(w.bonds.plastic_stretch, [](double u) { return u < 0; }));
    }
}

TEST_CASE(
    "conservation: a cluster turned rigidly by 1 rad feels no force, to first order in the step [(B5)]") {
  // velocities at n - 1/2 on the normal at n make slips of d dt^2/2 (w.n) w_t a step: forces in
  // proportion to dt
  ref::Parameters p = brittle();
  p.contact_damping = false;
  const auto turned_force = [&](int steps) {
    World w = world_of(colliding_cluster(), p);
    w.options.features.contact_damping = false;
    const Vec3 axis{1 / 3.0, 2 / 3.0, 2 / 3.0};
    const double t1 = 1.0 / steps;
    w.dt = t1;
    const auto turned = [&](const Vec3& a, double t) {
      return std::cos(t) * a + std::sin(t) * cross(axis, a) + ((1 - std::cos(t)) * dot(axis, a)) * axis;
    };
    std::fill(w.bonds.damping.begin(), w.bonds.damping.end(), 0.0);
    Scatter to;
    std::vector<BondLoad> load(w.bonds.padded);
    to.mode = ScatterMode::column, to.bond_load = load;
    for (int k = 1; k <= steps; ++k) {
      for (std::size_t row = 0; row < w.particles.size; ++row) {
        const Vec3 now = turned(w.particles.reference_position[row], k * t1);
        w.particles.velocity[row] = double(steps) * (now - w.particles.position[row]);
        w.particles.position[row] = now;
        w.particles.spin[row] = axis;
      }
      BondTable& b = w.bonds;
      w.bond_pass(bond_pass_in(w), bond_pass_history(w), 0, b.padded, to, nullptr);
    }
    double worst = 0, bound = 1e-12;
    for (std::size_t k = 0; k < w.bonds.size; ++k) {
      worst = std::max(worst, norm(load[k].force));
      bound = std::max(bound,
                       w.shear_ratio.front() * w.bonds.stiffness[k] * w.bonds.rest_length[k] * 0.25 / steps);
    }
    CHECK(count_broken(w).tension + count_broken(w).shear == 0);
    CHECK(worst < 1.1 * bound);
    return worst;
  };
  const double coarse = turned_force(20000), fine = turned_force(40000);
  CHECK(coarse / fine == doctest::Approx(2).epsilon(0.05));
}

TEST_CASE(
    "conservation: a free bonded pair vibrates at sqrt(2k/m)/(2 pi), its energy stays [closed form, 1e-9]") {
  // central differences: x(n) = A cos(n theta), sin(theta/2) = omega dt/2, exactly
  const ref::Parameters p = elastic_chain();
  World w = world_of(chain(2), p);
  const double omega = std::sqrt(2 * w.bonds.stiffness[0] / w.particles.mass[0]), A = 1e-6;
  const double theta = 2 * std::asin(omega * w.dt / 2);
  CHECK(std::sqrt(2 * p.E * pi * 1e-4 / 0.02 / (2500 * 4.0 / 3 * pi * 1e-6)) ==
        doctest::Approx(omega).epsilon(1e-12));
  w.particles.position[1].z += A, w.particles.position[0].z -= A;
  // v(-1/2) such that x(-1) = A cos(theta)
  w.particles.velocity[1].z = A * (1 - std::cos(theta)) / w.dt;
  w.particles.velocity[0].z = -w.particles.velocity[1].z;
  double worst = 0;
  double most = 0, least = 1e300;
  for (int n = 1; n <= 4000; ++n) {
    const Vec3 before = w.particles.velocity[1];
    const double stored = stored_energy(w);
    advance(w);
    worst = std::max(worst, std::abs(w.particles.position[1].z - w.particles.reference_position[1].z -
                                     A * std::cos(n * theta)));
    // K with the product of the two velocities around the step (B48)
    const double energy = stored + w.particles.mass[1] * before.z * w.particles.velocity[1].z;
    most = std::max(most, energy), least = std::min(least, energy);
  }
  CHECK(worst < 1e-9 * 0.02);
  CHECK(worst < 1e-6 * A);
  CHECK(most / least == doctest::Approx(1).epsilon(1e-6));
  const double x = omega * w.dt / 2;
  CHECK(most == doctest::Approx(0.5 * w.bonds.stiffness[0] * 4 * A * A * (1 - x * x)).epsilon(1e-6));
}

TEST_CASE(
    "conservation: standing waves of a chain have omega = 2 sqrt(k/m) sin(q pi/(2 n)), c = sqrt(1.5 E/rho) "
    "[1e-6 of the amplitude]") {
  const ref::Parameters p = elastic_chain();
  constexpr std::size_t n = 50;
  for (const int q : {1, 7, 40}) {
    World w = world_of(chain(n), p);
    const double omega =
        2 * std::sqrt(w.bonds.stiffness[0] / w.particles.mass[0]) * std::sin(q * pi / (2.0 * n));
    const double theta = 2 * std::asin(omega * w.dt / 2), A = 1e-6;
    const auto shape = [&](std::size_t k) { return std::cos(q * pi * (double(k) + 0.5) / n); };
    for (std::size_t k = 0; k < n; ++k) {
      w.particles.position[k].z += A * shape(k);
      w.particles.velocity[k].z = A * shape(k) * (1 - std::cos(theta)) / w.dt;
    }
    double worst = 0;
    for (int s = 1; s <= 3000; ++s) {
      advance(w);
      for (std::size_t k = 0; k < n; ++k)
        worst = std::max(worst, std::abs(w.particles.position[k].z - w.particles.reference_position[k].z -
                                         A * shape(k) * std::cos(s * theta)));
    }
    CHECK(worst < 1e-6 * A);
    // long waves: omega over wave number
    if (q == 1)
      CHECK(omega / (q * pi / (n * 0.02)) == doctest::Approx(std::sqrt(1.5 * p.E / p.density)).epsilon(3e-4));
  }
}

TEST_CASE(
    "conservation: a bar of 11 bonded spheres has the stiffness E A/L [verification_formulas, rel 1e-9]") {
  ref::Parameters p = elastic_chain();
  p.E = 1e9;
  p.xi = 0.9;
  p.damping_translation = 0.2;
  Assembly a = [&] {
    auto balls = chain(11);
    std::rotate(balls.begin(), balls.begin() + 1, balls.end());
    std::swap(balls[9], balls[10]);  // rows 9: the lowest, 10: the highest
    for (Ball& b : balls) b.x.z -= 0.1;
    return scene::free_body(balls, p.beta, scene::options(p).features);
  }();
  a.particles.free = 9, a.first_top = 10;
  REQUIRE(a.particles.position[9].z == doctest::Approx(-0.1));
  World w = make_world(a, scene::material_of(p), scene::factor(p), scene::options(p));
  scene::drive(w, 0.05, -0.05);
  for (int k = 0; k < 400; ++k) advance(w);
  w.platens.velocity = {};
  for (int k = 0; k < 40000; ++k) advance(w);
  const double strain = approach(w.platens) / 0.2, A = pi * 1e-4;
  CHECK(strain == doctest::Approx(2 * 400 * w.dt * 0.05 / 0.2).epsilon(1e-12));
  for (const double stress : scene::platen_stress(w.platens))
    CHECK(stress * w.platens.section / (A * strain) == doctest::Approx(1e9).epsilon(1e-9));
  for (std::size_t k = 0; k < 9; ++k)  // uniform
    CHECK(std::abs(w.particles.position[k].z - (1 - strain) * a.particles.position[k].z) <
          1e-8 * strain * 0.1);
}

TEST_CASE(
    "conservation: global damping takes its share of every force on what moves, and nothing where v is 0 "
    "[(P39) (P40), exact]") {
  ref::Parameters p = elastic_chain();
  World undamped = world_of(chain(2), p);
  p.damping_translation = p.damping_rotation = 0.3;
  World w = world_of(chain(2), p);
  w.dt = undamped.dt;
  for (World* x : {&undamped, &w}) x->particles.position[1].z += 1e-6;
  advance(undamped);
  advance(w);
  CHECK(w.particles.velocity == undamped.particles.velocity);  // from rest: no damping in the first step
  CHECK(w.particles.velocity[0].z > 0);
  const double kick = undamped.particles.velocity[0].z;
  advance(undamped);
  advance(w);
  const double second = undamped.particles.velocity[0].z - kick;
  CHECK(w.particles.velocity[0].z == doctest::Approx(kick + second - 0.3 * std::abs(second)).epsilon(1e-9));
  // what moves under no force is not held back, nor is what stands under one pushed aside
  const Vec3 still{}, F{3, -4, 12}, v{1, 2, 2};
  const auto damped = [](const Vec3& force, const Vec3& velocity, double part) {
    return force - brake_on(velocity, force, part, false, 1.0) * velocity;
  };
  CHECK(damped(F, still, 0.3) == F);
  CHECK(damped(still, v, 0.3) == still);
  const Vec3 d = damped(F, v, 0.3);
  CHECK(norm(d - (F - 0.3 * 13 / 3 * v)) < 1e-14 * 13);
  CHECK(dot(F - d, v) == doctest::Approx(0.3 * 13 * 3).epsilon(1e-14));
}

TEST_CASE(
    "viscous global damping: a mass on a spring decays as exp(-c t/2), turning and moving [(B113), 1e-3; "
    "ledger 1e-6]") {
  reference::Parameters p;
  p.contact_damping = false;
  p.xi = 0;
  Assembly a = scene::free_body({{1, 0.01, {0, 0, -0.01}}, {2, 0.01, {0, 0, 0.01}}}, p.beta,
                                scene::options(p).features);
  WorldOptions o = scene::options(p);
  constexpr double rate = 4000;
  o.global_damping = {rate, rate, true};
  o.ledger = true, o.safety = 0.05;
  World w = make_world(a, scene::material_of(p), scene::factor(p), o);
  w.particles.velocity[0].z = -1e-3, w.particles.velocity[1].z = 1e-3;
  w.particles.spin[0].z = w.particles.spin[1].z = 5.0;  // about the bond, both alike: nothing but the damping
  const double k = w.bonds.stiffness[0], m = w.particles.mass[0];
  const double omega = std::sqrt(2 * k / m - 0.25 * rate * rate), period = 2 * std::numbers::pi / omega;
  double most = 0;
  const double end = 10 * period;
  while (w.time < end) {
    if (w.time > end - 1.05 * period) most = std::max(most, w.particles.position[1].z - 0.01);
    advance(w);
  }
  CHECK(most == doctest::Approx(1e-3 / omega * std::exp(-0.5 * rate * (end - 0.75 * period))).epsilon(2e-2));
  CHECK(w.particles.spin[0].z == doctest::Approx(5.0 * std::exp(-rate * w.time)).epsilon(1e-3));
  record_balance(w.ledger, energy_balance(w));
  CHECK(energy_error(w.ledger) < 1e-6);
  CHECK(w.ledger.damped_motion.done > 0);
}
