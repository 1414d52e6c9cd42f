// What holds a confined specimen together at its ends and beside it: planes behind the layers,
// pressure that leaves what nothing holds, limits that begin where stage 1 ends.
#include <doctest/doctest.h>

#include "core/bonding/compressive_limits.hpp"
#include "core/boundary/release.hpp"
#include "core/stepping/step.hpp"
#include "core/world/energy_accounting.hpp"
#include "tests/scene.hpp"

using namespace breccia;

namespace {

/// A free sphere half-way between two that are held and stand aside, bonded to nobody.
World between_layers(double speed, reference::Parameters p = {}) {
  p.contact_damping = false;
  WorldOptions o = scene::options(p);
  o.ledger = true;
  o.global_damping = {0.0, 0.0};
  Assembly a = scene::free_body({{1, 0.01, {0, 0, 0}, 0, {0, 0, speed}},
                                 {2, 0.01, {0.1, 0, -0.05}},
                                 {3, 0.01, {0.1, 0, 0.05}},
                                 {4, 0.01, {0.12, 0, 0.05}}},
                                p.beta, o.features);
  a.particles.free = 1, a.first_top = 2;
  World w = make_world(a, scene::material_of(p), scene::factor(p), o);
  w.dt = 1e-7;
  return w;
}

}  // namespace

TEST_CASE(
    "end walls: a sphere bounces off the plane behind a layer as off a spring [(B111), 1e-3; ledger 1e-6]") {
  World w = between_layers(20.0);
  REQUIRE(w.end_walls.enabled);
  CHECK(w.end_walls.place[0] == doctest::Approx(-0.06));
  CHECK(w.end_walls.place[1] == doctest::Approx(0.06));
  const double k = 0.5 * std::numbers::pi * 28e9 * 0.01, m = w.particles.mass[0];
  double farthest = 0, push = 0;
  const int steps = static_cast<int>((2 * 0.05 / 20.0 + std::numbers::pi * std::sqrt(m / k)) / w.dt);
  for (int step = 0; step < steps; ++step) {
    advance(w);
    farthest = std::max(farthest, w.particles.position[0].z);
    push = std::max(push, std::abs(w.platens.force[1].z));
  }
  const double depth = 20.0 * std::sqrt(m / k);
  REQUIRE(depth < 0.01);
  CHECK(farthest == doctest::Approx(0.05 + depth).epsilon(1e-3));
  CHECK(push == doctest::Approx(k * depth).epsilon(1e-3));
  CHECK(w.particles.velocity[0].z == doctest::Approx(-20.0).epsilon(1e-3));
  CHECK(w.particles.position[0].z == doctest::Approx(0.0).epsilon(1e-3).scale(0.05));
  record_balance(w.ledger, energy_balance(w));
  CHECK(energy_error(w.ledger) < 1e-6);
  CHECK(std::abs(w.ledger.walls.done) < 1e-3 * 0.5 * m * 400);
}

TEST_CASE("end walls: they move with the platens, and push no harder beyond a radius [(B111)]") {
  World w = between_layers(0.0);
  w.platens.travel[1].z = -0.055;  // the plane is at 5 mm, the sphere reaches 5 mm beyond it
  push_back(w.end_walls, w.platens, w.particles, w.partition, 0, w.dt, 1);
  const double k = w.end_walls.stiffness * 0.01;
  CHECK(w.particles.force[0].z == doctest::Approx(-k * 0.005).epsilon(1e-12));
  CHECK(w.end_walls.push[1] == w.particles.force[0].z);
  w.particles.force[0] = {};
  w.platens.travel[1].z = -0.075;
  push_back(w.end_walls, w.platens, w.particles, w.partition, 1, w.dt, 1);
  CHECK(w.particles.force[0].z == doctest::Approx(-k * 0.01).epsilon(1e-12));
  w.particles.force[0] = {};
  w.platens.travel = {};
  push_back(w.end_walls, w.platens, w.particles, w.partition, 2, w.dt, 1);
  CHECK(w.particles.force[0].z == 0.0);
}

TEST_CASE("release: pressure leaves a sphere that it has moved by its radius, unheld [(B112), 16 steps]") {
  World w = between_layers(0.0);
  Confinement& c = w.confinement;
  c.rows = {0}, c.weight = {3e-4}, c.force = {{}}, c.alone = {0.0}, c.surface = 3e-4;
  c.pressure = 1e6;
  ParticleTable& p = w.particles;
  const double push = 300.0, time = std::sqrt(2 * 0.01 * p.mass[0] / push);
  const auto after = [&](Vec3 more, double seconds) {
    const auto steps = static_cast<std::uint64_t>(seconds / w.dt);
    for (std::uint64_t step = 0; step < steps; ++step) {
      c.force[0] = c.alone[0] < 0.0 ? Vec3{} : Vec3{-push, 0, 0};
      p.force[0] = c.force[0] + more;
      release_unheld(c, p, w.partition, step, w.dt);
    }
    return c.alone[0];
  };
  CHECK(after({1, 0, 0}, 2 * time) == 0.0);  // something else acts on it
  CHECK(after({}, 0.98 * time) > 0.0);
  CHECK(unheld(c, p, w.partition) == std::vector<Gid>{1});
  CHECK(after({1, 0, 0}, 20 * w.dt) == 0.0);  // met something after all
  CHECK(unheld(c, p, w.partition).empty());
  CHECK(after({}, 1.02 * time) == released);
  CHECK(after({1, 0, 0}, time) == released);  // for good
  p.force[0] = {};
  p.position[0] = {0.02, 0, 0};
  apply_confinement(c, p, w.partition);
  CHECK(p.force[0] == Vec3{});
  CHECK(c.acting == 0.0);
}

TEST_CASE(
    "limits: those of a specimen become those of bonds, and stage 1 raises them [(B108), (B109), 1e-14]") {
  Material m;
  m.limit_compressive_stress = {20e6, 45e6, 70e6};
  const double alpha = 0.8, fabric = 1.5;
  const HydrostaticBranch law{HydrostaticResponse::law, 12e6}, elastic{HydrostaticResponse::elastic, 12e6};
  CHECK(with_bond_limits(m, law, alpha, fabric).limit_compressive_stress == m.limit_compressive_stress);
  CHECK(with_bond_limits(m, elastic, alpha, fabric).limit_compressive_stress[1] ==
        doctest::Approx(55e6).epsilon(1e-14));
  m.limits = LimitStress::macroscopic;
  CHECK(with_bond_limits(m, law, alpha, fabric).limit_compressive_stress[2] ==
        doctest::Approx(70e6 / 1.2).epsilon(1e-14));
  CHECK(with_bond_limits(m, elastic, alpha, fabric).limit_compressive_stress[0] ==
        doctest::Approx(32e6 / 1.2).epsilon(1e-14));
}

TEST_CASE("limits: the mean stress of the bonds of a specimen under even pressure [(B108), affine, 1e-12]") {
  // every bond shortened by the same strain e: the stress tensor of Love has p = alpha T E e
  const Assembly a = assemble(scene::small_packing(400), scene::small_cylinder(), {}, Features{}, 1);
  double fabric = 0, virial = 0, mean = 0, weight = 0;
  const double young = 28e9, alpha = 0.9, strain = 1e-4;
  for (std::size_t k = 0; k < a.bonds.size; ++k) {
    const double area = alpha * a.bonds.area[k], length = a.bonds.rest_length[k];
    fabric += a.bonds.area[k] * length / (3.0 * a.volume());
    virial += area * young * strain * length / (3.0 * a.volume());
    mean += area * length * young * strain, weight += area * length;
  }
  CHECK(hydrostatic_bond_stress(virial, alpha, fabric) == doctest::Approx(mean / weight).epsilon(1e-12));
}
