// Resistance to rolling of broken bonds and contacts.
#include <doctest/doctest.h>

#include <random>

#include "core/stepping/step.hpp"
#include "core/tables/state_hash.hpp"
#include "core/world/energies.hpp"
#include "core/world/energy_accounting.hpp"
#include "core/world/make_world.hpp"
#include "tests/scene.hpp"

using namespace breccia;

namespace {

/// Two spheres pressed together, the bond between them broken, with these spins.
World pressed_pair(const Vec3& spin_lo, const Vec3& spin_hi, double overlap, bool broken = true) {
  reference::Parameters p;
  p.contact_damping = false;
  WorldOptions o = scene::options(p);
  o.global_damping = {0, 0};
  o.ledger = true;
  Material m = scene::material_of(p);
  m.rolling_friction = 0.3;
  World w = make_world(
      scene::free_body({{1, 0.01, {0, 0, 0}, 1, {}, spin_lo}, {2, 0.015, {0, 0, 0.025}, 1, {}, spin_hi}},
                       p.beta, o.features),
      m, scene::factor(p), o);
  w.particles.position[1].z -= overlap;
  if (broken) w.bonds.damage_normal[0] = 1.0;
  w.dt = 1e-8;
  return w;
}

Vec3 change_of_spin(World& w) {
  const Vec3 before = w.particles.spin[0];
  advance(w);
  return w.particles.spin[0] - before;
}

}  // namespace

TEST_CASE(
    "rolling: a spring k_s R^2 that slips at mu_r N R, none against a twist or through a bond [(B116), "
    "1e-9]") {
  const Vec3 about_x{100, 0, 0};
  const double R = 0.01 * 0.015 / 0.025;
  World w = pressed_pair(about_x, {}, 1e-5);
  const double k = w.shear_ratio.front() * w.bonds.stiffness[0] * R * R,
               most = 0.3 * w.bonds.stiffness[0] * 1e-5 * R;
  const auto turn = [&](double angle) {  // as a whole, about x
    w.particles.spin[0] = {angle / w.dt, 0, 0}, w.particles.spin[1] = {};
    w.particles.velocity[0] = w.particles.velocity[1] = {};
    advance(w);
    return w.bonds.couple[0].x;
  };
  CHECK(turn(0.3 * most / k) == doctest::Approx(-0.3 * most).epsilon(1e-9));
  CHECK(turn(0.3 * most / k) == doctest::Approx(-0.6 * most).epsilon(1e-9));
  CHECK(turn(5 * most / k) == doctest::Approx(-most).epsilon(1e-4));
  CHECK(turn(-0.5 * most / k) == doctest::Approx(-0.5 * most).epsilon(1e-4));
  const double i = inertia(sphere_inertia_factor, w.particles.mass[0], 0.01);
  World one = pressed_pair(about_x, {}, 1e-5), without = pressed_pair(about_x, {}, 1e-5);
  without.bonds.couple.clear(), without.material.rolling_friction = 0;
  const Vec3 change = change_of_spin(one) - change_of_spin(without);
  CHECK(change.x == doctest::Approx(-k * 100 * w.dt * w.dt / i).epsilon(1e-6));
  for (const auto& [lo, hi, broken] :
       {std::tuple{Vec3{0, 0, 100}, Vec3{}, true}, {about_x, about_x, true}, {about_x, Vec3{}, false}}) {
    World other = pressed_pair(lo, hi, 1e-5, broken);
    advance(other);
    CHECK(norm(other.bonds.couple[0]) == 0);
  }
}

TEST_CASE(
    "rolling: in a breaking specimen energy is conserved, and sums have the same bits for any threads "
    "[(B116), ledger 1e-5]") {
  reference::Parameters p;
  p.beta = 0.03;
  WorldOptions o = scene::options(p);
  o.ledger = true, o.scatter = ScatterKind::gather, o.safety = 0.2;
  Material m = scene::material_of(p);
  const auto run = [&](double friction, int threads) {
    o.threads = threads;
    m.rolling_friction = friction;
    const Assembly a = assemble(scene::small_packing(300), scene::small_cylinder(),
                                {p.beta, {}, AreaRule::minimum, {}}, o.features, threads);
    World w = make_world(a, m, scene::factor(p), o);
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> in(-1, 1);
    for (std::size_t k = 0; k < w.particles.free; ++k)
      w.particles.velocity[k] =
          10.0 * Vec3{in(random), in(random), in(random)} + Vec3{0, 0, -600 * w.particles.position[k].z};
    scene::drive(w, 30, -30);
    for (int step = 0; step < 600; ++step) advance(w);
    return w;
  };
  World w = run(0.5, 1), plain = run(0.0, 1), two = run(0.5, 2);
  CHECK(count_broken(w).tension + count_broken(w).shear > 100);
  const EnergyBalance rolled = energy_balance(w), slid = energy_balance(plain);
  record_balance(w.ledger, rolled), record_balance(plain.ledger, slid);
  CHECK(energy_error(w.ledger) < 1.5 * energy_error(plain.ledger) + 1e-5);
  CHECK(rolled.friction > 1.05 * slid.friction);
  CHECK(state_hash(w.particles, w.bonds) == state_hash(two.particles, two.bonds));
  CHECK(state_hash(w.particles, w.bonds) != state_hash(plain.particles, plain.bonds));
}
