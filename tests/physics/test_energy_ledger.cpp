// The energy ledger: every channel on scenes whose answer is known, and what the balance leaves
// over.
#include <doctest/doctest.h>

#include <random>

#include "core/loading/load_test.hpp"
#include "core/stepping/step.hpp"
#include "core/world/energies.hpp"
#include "core/world/energy_accounting.hpp"
#include "core/world/make_world.hpp"
#include "tests/scene.hpp"

using namespace breccia;
namespace ref = breccia::reference;
using scene::Ball;

namespace {

WorldOptions ledger_options(const ref::Parameters& p) {
  WorldOptions o = scene::options(p);
  o.features = scene::features(p);
  o.ledger = true;
  return o;
}

/// The columns that the loop with a ledger has.
Features columns_of(const ref::Parameters& p) {
  return built_features(scene::law(p), scene::features(p), {Precision::full, true});
}

World ledger_world(const std::vector<Ball>& balls, const ref::Parameters& p, double dt) {
  World w = make_world(scene::free_body(balls, p.beta, columns_of(p)), scene::material_of(p),
                       scene::factor(p), ledger_options(p));
  w.dt = dt;
  return w;
}

/// Two spheres one upon the other, both held, bonded at rest.
World held_pair(const ref::Parameters& p, double dt) {
  Assembly a = scene::free_body({{1, 0.01, {0, 0, -0.01}}, {2, 0.01, {0, 0, 0.01}}}, p.beta, columns_of(p));
  a.particles.free = 0, a.first_top = 1;
  World w = make_world(a, scene::material_of(p), scene::factor(p), ledger_options(p));
  w.dt = dt;
  return w;
}

/// Moves the platens apart by `distance`, m, in even steps from rest to rest, then one step at
/// rest.
void pull(World& w, double distance, int steps) {
  const double speed = distance / (steps * w.dt);
  for (int k = 0; k < steps; ++k) {
    scene::drive(w, -0.5 * speed, 0.5 * speed);
    advance(w);
  }
  scene::drive(w, 0, 0);
  advance(w);
}

/// A few balls that fly into each other, bonded by threes.
std::vector<Ball> colliding() {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> in(-1, 1);
  std::vector<Ball> balls;
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 3; ++y)
      for (int z = 0; z < 3; ++z) {
        Ball b{1 + balls.size(), 0.05 + 0.004 * in(random),
               Vec3{0.1 * x, 0.1 * y, 0.1 * z} + 0.004 * Vec3{in(random), in(random), in(random)},
               x < 2 ? 1 : 2};
        b.v = Vec3{x < 2 ? 3.0 : -3.0, 0, 0} + 2.0 * Vec3{in(random), in(random), in(random)};
        b.w = 20.0 * Vec3{in(random), in(random), in(random)};
        balls.push_back(b);
      }
  return balls;
}

ref::Parameters elastic() {
  ref::Parameters p;
  p.E = 1e9;
  p.plasticity = p.breakage = p.contact_damping = p.unbonded_contacts = false;
  p.xi = 0;
  return p;
}

}  // namespace

TEST_CASE("A bond that is pulled apart costs its fracture energy, and the platens' work is all of it") {
  ref::Parameters p;
  p.contact_damping = false;
  p.xi = 0;
  p.delta_n = 0.8;
  World w = held_pair(p, 1e-7);
  const double area = w.bonds.area[0], u_l = p.sigma_t * area / w.bonds.stiffness[0];
  const double energy = 0.5 * p.sigma_t * area * u_l * 1.8;
  for (const int steps : {100, 1000}) {
    World pulled = w;
    pull(pulled, 2.0 * u_l, steps);
    const EnergyBalance e = energy_balance(pulled);
    CHECK(e.damage == doctest::Approx(energy).epsilon(1e-12));
    CHECK(e.stored == 0.0);
    CHECK(e.work == doctest::Approx(energy).epsilon(4.0 / steps / steps));
    CHECK(std::abs(e.failure) < energy * 4.0 / steps / steps);
  }
}

TEST_CASE("A bond that is crushed and let go keeps the plastic work") {
  ref::Parameters p;
  p.contact_damping = false;
  p.xi = 0;
  World w = held_pair(p, 1e-7);
  const double area = w.bonds.area[0], rest = w.bonds.rest_length[0];
  const double u_1 = p.LCS[0] / p.E * rest, far = 1.5 * u_1;  // beyond the first limit, below the second
  const double sigma = p.LCS[0] + p.E / p.YRC[0] * 0.5 * u_1 / rest, u_p = far - sigma / p.E * rest;
  pull(w, -far, 1500);
  EnergyBalance e = energy_balance(w);
  const double plastic = 0.5 * (p.LCS[0] + sigma) * area * u_p;
  CHECK(e.plastic == doctest::Approx(plastic).epsilon(1e-5));
  CHECK(e.stored == doctest::Approx(0.5 * sigma * sigma / p.E * area * rest).epsilon(1e-9));
  pull(w, far - u_p, 1500);
  e = energy_balance(w);
  CHECK(e.plastic == doctest::Approx(plastic).epsilon(1e-5));
  CHECK(e.work == doctest::Approx(plastic).epsilon(1e-5));
  CHECK(e.stored < 1e-12 * plastic);
}

TEST_CASE("The dashpot of a pair takes up what the trapezoid says") {
  ref::Parameters p = elastic();
  p.contact_damping = true;
  p.xi = 0.9;
  World w = held_pair(p, 1e-6);
  const double speed = 0.01;  // m/s, of elongation
  const int steps = 200;
  pull(w, speed * steps * w.dt, steps);
  // constant rate: full steps of c v^2, the first and the last half force count half each
  const double power = w.bonds.damping[0] * speed * speed;
  CHECK(energy_balance(w).contact_viscous == doctest::Approx(power * w.dt * (steps - 0.5)).epsilon(1e-9));
}

TEST_CASE(
    "An elastic specimen that is pressed and let go balances to a millionth, the better the smaller the "
    "step") {
  // the spring along a bond balances exactly; what is left comes from the shear, whose slip is
  // taken against the normal at the end of the step: force times elongation times turn of the bond,
  // a first-order term
  ref::Parameters p = elastic();
  p.E = 28e9;
  const Assembly a = assemble(scene::small_packing(100), scene::small_cylinder(), {}, columns_of(p), 1);
  const auto worst = [&](double fraction) {
    World w = make_world(a, scene::material_of(p), scene::factor(p), ledger_options(p));
    w.dt = fraction * w.critical_dt;
    constexpr double duration = 4e-4;  // s; at rest again at the end
    while (w.time < duration) {
      const double speed = 0.1 * std::sin(2.0 * std::numbers::pi * w.time / duration);
      scene::drive(w, speed, -speed);
      advance(w);
      record_balance(w.ledger, energy_balance(w));
    }
    for (const auto& [name, channel] : loss_channels)
      CHECK(std::abs(energy_balance(w).*channel) < 1e-12 * w.ledger.most_work);
    return energy_error(w.ledger);
  };
  const double coarse = worst(0.8), middle = worst(0.4), fine = worst(0.1);
  CHECK(coarse < 1e-6);
  CHECK(coarse > 1.8 * middle);
  CHECK(middle > 3.5 * fine);
}

TEST_CASE("Bodies that break up and rub balance, in every channel, with the square of the step") {
  ref::Parameters p;
  p.E = 1e9;
  p.LCS = {2e6, 4e6, 6e6};
  p.sigma_t = 0.5e6;
  p.tau_f = 1e6;
  p.xi = 0.2;
  p.damping_translation = p.damping_rotation = 0.1;
  struct Variant {
    ref::Criterion criterion;
    double unloads, yield_stress;
  };
  for (const auto& [criterion, unloads, yield_stress] : {Variant{ref::Criterion::uncoupled, 1, 0},
                                                         {ref::Criterion::coupled, 1, 0},
                                                         {ref::Criterion::mohr_coulomb, 1, 0},
                                                         {ref::Criterion::uncoupled, 2, 0},
                                                         {ref::Criterion::uncoupled, 2, 3e6}}) {
    p.criterion = criterion, p.unloads = unloads, p.yield_stress = yield_stress;  // (B118)
    const World w = ledger_world(colliding(), p, 0);
    const auto error_at = [&](double fraction) {
      World run = w;
      run.dt = fraction * w.critical_dt;
      EnergyBalance e;
      while (run.time < 8e-3) {
        advance(run);
        e = energy_balance(run);
        record_balance(run.ledger, e);
      }
      CHECK(count_broken(run).tension + count_broken(run).shear > 30);
      CHECK(run.contacts.size > 0);
      for (const auto& [name, channel] : loss_channels) {
        INFO(std::string(name));
        CHECK(e.*channel > 1e-3 * e.work);
      }
      return energy_error(run.ledger);
    };
    const double coarse = error_at(0.8), fine = error_at(0.1);
    CHECK(coarse < 0.03);
    CHECK(fine < coarse / 10.0);
  }
}

TEST_CASE("A compression test balances to a thousandth, whatever the number of threads") {
  ref::Parameters p;
  p.damping_translation = p.damping_rotation = 0.1;
  const Assembly a = assemble(scene::small_packing(300), scene::small_cylinder(), {}, Features{}, 1);
  const auto run = [&](int threads, double confinement) {
    WorldOptions o = ledger_options(p);
    o.scatter = ScatterKind::gather;
    o.threads = threads;
    AreaFactor factor = scene::factor(p);
    factor.alpha = 0.8;
    World w = make_world(a, scene::material_of(p), factor, o);
    LoadTest test;
    test.confinement = confinement;
    test.platen_speed = 0.2;
    test.stop_strain = 0.004;
    test.frames = 0;
    LoadResult result;
    run_load_test(w, a, test, {}, result);
    CHECK(energy_error(w.ledger) < 1e-3);
    const CurveRow& last = result.record.rows.back();
    CHECK(last.work_J > 0.0);
    CHECK(last.dissipated_J > 0.3 * last.work_J);
    return energy_balance(w);
  };
  for (const double confinement : {0.0, 5e6}) {
    const EnergyBalance one = run(1, confinement), two = run(2, confinement);
    CHECK(one.plastic > 0.0);
    CHECK(one.failure > 0.0);
    CHECK(one.work == two.work);
    for (const auto& [name, channel] : loss_channels) CHECK(one.*channel == two.*channel);
  }
}
