// What stops a run: each guard made to fire by a state or a run that has gone wrong, and none of
// them by a specimen that fails as violently as the law allows.
#include <doctest/doctest.h>

#include "core/base/error.hpp"
#include "core/checks/diagnosis.hpp"
#include "core/checks/stability_checks.hpp"
#include "core/loading/load_test.hpp"
#include "core/stepping/step.hpp"
#include "core/world/energies.hpp"
#include "core/world/make_world.hpp"
#include "tests/scene.hpp"

using namespace breccia;
namespace ref = breccia::reference;

namespace {

struct Packed {
  Assembly assembly;
  World world;
};

Packed packed(const ref::Parameters& p, std::size_t spheres = 200) {
  Packed made;
  made.assembly =
      assemble(scene::small_packing(spheres), scene::small_cylinder(), {}, scene::options(p).features, 1);
  made.world = make_world(made.assembly, scene::material_of(p), scene::factor(p), scene::options(p));
  return made;
}

void look(StabilityChecks& checks, const World& w) { check(checks, w, kinetic_energy(w), stored_energy(w)); }

/// What a guard says, empty where none fires.
std::string said(StabilityChecks checks, const World& w) {
  try {
    look(checks, w);
  } catch (const SimulationBroke& why) {
    return why.what();
  }
  return "";
}

bool has(const std::string& text, const std::string& word) { return text.find(word) != std::string::npos; }

LoadTest compression(double speed, double strain) {
  LoadTest test;
  test.platen_speed = speed;
  test.stop_strain = strain;
  test.stop_after_peak = 0;
  test.frames = 0;
  return test;
}

std::string end_of(Packed& made, const LoadTest& test) {
  LoadResult result;
  try {
    run_load_test(made.world, made.assembly, test, {}, result);
  } catch (const SimulationBroke& why) {
    return why.what();
  }
  return "";
}

}  // namespace

TEST_CASE("stability checks: a number that is lost is named with its particle and bond") {
  Packed made = packed({});
  World& w = made.world;
  const StabilityChecks checks = make_stability_checks(w);
  CHECK(said(checks, w) == "");
  w.particles.velocity[17].y = std::nan("");
  const std::string velocity = said(checks, w);
  CHECK(has(velocity, fmt::format("particle {} has a velocity that is not a number", w.particles.gid[17])));
  CHECK(has(velocity, "its bond "));
  CHECK(has(velocity, "time.safety = 0.4"));
  w.particles.velocity[17].y = 0;
  w.bonds.shear_y[5] = w.bonds.shear_x[5] = std::nan("");
  CHECK(has(said(checks, w), fmt::format("bond {}-{} has a force that is not a number", w.bonds.gid_lo[5],
                                         w.bonds.gid_hi[5])));
}

TEST_CASE("stability checks: a test with a step beyond the limit is stopped before it has a curve") {
  for (const double beyond : {1.3, 2.0}) {
    Packed made = packed({});
    made.world.dt = beyond * made.world.critical_dt;
    const std::string why = end_of(made, compression(0.1, 0.01));
    INFO(why);
    CHECK(has(why, "energy comes from nowhere"));
    CHECK(has(why, "is beyond the critical"));
    CHECK(has(why, "time.safety = 0.8"));
    CHECK(made.world.step < 400);
  }
}

TEST_CASE(
    "stability checks: no failure of a specimen fires, however violent, nor do pressure, unloading, fast "
    "platens") {
  ref::Parameters brittle;
  brittle.delta_n = brittle.delta_s = 0;
  brittle.xi = 0;
  brittle.damping_translation = brittle.damping_rotation = 0;
  Packed made = packed(brittle);
  CHECK(end_of(made, compression(1.0, 0.02)) == "");
  CHECK(count_broken(made.world).tension + count_broken(made.world).shear > made.world.bonds.size / 4);

  Packed pulled = packed(brittle);
  LoadTest tension = compression(0.2, 0.003);
  tension.loading = Loading::tension;
  CHECK(end_of(pulled, tension) == "");
  CHECK(count_broken(pulled.world).tension > 20);

  Packed cycled = packed({});
  LoadTest cycles = compression(0.2, 0.004);
  cycles.confinement = 20e6;
  cycles.unload_at = {0.001, 0.002};
  cycles.unload_to = 0.01;
  CHECK(end_of(cycled, cycles) == "");

  Packed crushed = packed({});
  CHECK(end_of(crushed, compression(10.0, 0.05)) == "");
}

TEST_CASE(
    "stability checks: the energy of a pair at a step s of its limit wavers by (1 + s)/(1 - s) [closed "
    "form]") {
  ref::Parameters p;
  p.plasticity = p.breakage = p.contact_damping = false;
  p.xi = 0;
  p.damping_translation = p.damping_rotation = 0;
  Assembly a =
      scene::free_body({{1, 0.01, {0, 0, 0}}, {2, 0.01, {0, 0, 0.02}}}, 0.01, scene::options(p).features);
  World w = make_world(a, scene::material_of(p), scene::factor(p), scene::options(p));
  const double s = 0.8;
  w.dt = s * 2 / std::sqrt(2 * w.bonds.stiffness[0] / w.particles.mass[0]);
  w.particles.velocity[1].z = 1e-4;
  double most = 0, least = 1;
  for (int k = 0; k < 3000; ++k) {
    advance(w);
    const double energy = kinetic_energy(w) + stored_energy(w) -
                          0.5 * 2 * w.particles.mass[0] * 0.25e-8;  // less that of the pair as a whole
    most = std::max(most, energy), least = std::min(least, energy);
  }
  CHECK(most / least == doctest::Approx((1 + s) / (1 - s)).epsilon(1e-3));
  CHECK(most / least < allowed_excess(w));
}

TEST_CASE("stability checks: work of the platens is what an elastic specimen holds [3 %]") {
  ref::Parameters p;
  p.plasticity = p.breakage = false;
  p.xi = 0;
  p.damping_translation = p.damping_rotation = 0;
  Packed made = packed(p);
  World& w = made.world;
  CHECK(end_of(made, compression(0.5, 0.001)) == "");
  const double layers = 0.5 * (w.platens.mass[0] + w.platens.mass[1]) * 0.25;
  CHECK(w.platens.work == doctest::Approx(kinetic_energy(w) - layers + stored_energy(w)).epsilon(0.03));
  CHECK(w.platens.work > 0);
}

TEST_CASE("stability checks: a particle faster than a wave, sqrt(2 k/m) d0 for equal spheres") {
  Packed made = packed({});
  World& w = made.world;
  double square = 0;
  for (std::size_t k = 0; k < w.bonds.size; ++k) {
    const double m = w.particles.mass[w.bonds.row_lo[k]], n = w.particles.mass[w.bonds.row_hi[k]];
    square = std::max(square, w.bonds.stiffness[k] * (1 / m + 1 / n) * std::pow(w.bonds.rest_length[k], 2));
  }
  CHECK(fastest_wave(w) == doctest::Approx(std::sqrt(square)).epsilon(1e-12));
  w.particles.velocity[3].x = 0.99 * fastest_wave(w);
  CHECK(said(make_stability_checks(w), w) == "");
  w.particles.velocity[3].x = 1.01 * fastest_wave(w);
  CHECK(has(said(make_stability_checks(w), w), fmt::format("particle {} moves at", w.particles.gid[3])));
}

TEST_CASE(
    "stability checks: a bond that turns through more than a right angle in a step, of nested spheres") {
  ref::Parameters p;
  Assembly a = scene::free_body({{4, 0.01, {0, 0, 0}}, {7, 0.01, {0, 0, 0.02}}, {9, 0.005, {1e-6, 0, 0}}},
                                0.01, scene::options(p).features);
  World w = make_world(a, scene::material_of(p), scene::factor(p), scene::options(p));
  w.particles.velocity[2].x = 0.9e-6 / w.dt;
  CHECK(said(make_stability_checks(w), w) == "");
  w.particles.velocity[2].x = 1.1e-6 / w.dt;
  const std::string why = said(make_stability_checks(w), w);
  INFO(why);
  CHECK(has(why, "bond 4-9, 1e-06 m long, has turned through more than a right angle"));
  CHECK(has(why, "the spheres are nested"));
}

TEST_CASE("stability checks: a particle is lost ten sizes away") {
  Packed made = packed({});
  World& w = made.world;
  const StabilityChecks checks = make_stability_checks(w);
  std::fill(w.bonds.damage_normal.begin(), w.bonds.damage_normal.end(), 1.0);
  w.particles.position[8].x += 9.0 * checks.size;
  CHECK(said(checks, w) == "");
  w.particles.position[8].x += 2.0 * checks.size;
  CHECK(has(said(checks, w), fmt::format("particle {} is lost", w.particles.gid[8])));
}

TEST_CASE(
    "stability checks: contacts that are stiffer than what the step was found from are named as the cause") {
  Packed made = packed({});
  World& w = made.world;
  ContactTable& c = w.contacts;
  c.resize(1, w.features);
  c.row_lo[0] = 2, c.row_hi[0] = 90;
  c.free_length[0] = 1.0;
  c.stiffness[0] = 8.0 * w.particles.mass[2] / (w.dt * w.dt);
  w.particles.velocity[2].z = std::nan("");
  const std::string why = said(make_stability_checks(w), w);
  INFO(why);
  CHECK(has(why, "the contacts that have formed on it"));
}
