// What holds a confined specimen together at its ends and beside it: planes behind the layers,
// pressure that leaves what nothing holds, limits that begin where stage 1 ends.
#include <doctest/doctest.h>

#include "core/bonding/compressive_limits.hpp"
#include "core/boundary/loose_surface.hpp"
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

TEST_CASE(
    "loose surface: a sphere that nothing touches drifts at 0.1 p/sqrt(E density), others are pressed "
    "[(B112)]") {
  World w = between_layers(0.0);
  Confinement& c = w.confinement;
  c.rows = {0}, c.weight = {3e-4}, c.force = {{}}, c.drifts = {0}, c.surface = 3e-4;
  c.pressure = 100e6;
  ParticleTable& p = w.particles;
  p.position[0] = {0.03, 0, 0};
  const double impedance = std::sqrt(28e9 * 2500.0), most = 0.1 * 100e6 / impedance,
               per_time = p.mass[0] / w.dt;
  const Vec3 push{-3e4, 0, 0};
  const auto after = [&](Vec3 velocity, Vec3 more) {
    p.velocity[0] = velocity, c.force[0] = push, p.force[0] = push + more;
    let_loose_drift(c, p, w.partition, {impedance, true, w.dt, 1});
    return velocity + (1.0 / per_time) * p.force[0];
  };
  CHECK(norm(after({-50, 7, 3}, {})) == doctest::Approx(most).epsilon(1e-12));
  CHECK(c.force[0] == p.force[0]);  // the work is that of the pressure
  CHECK(c.drifts[0]);
  CHECK(norm(after({-50, 7, 3}, {1, 0, 0})) > 50);
  CHECK(c.force[0] == push);
  CHECK_FALSE(c.drifts[0]);
}

TEST_CASE(
    "loose surface: the fluid brakes what flies through it, and books what it takes [(B112), ledger 1e-6]") {
  World w = between_layers(300.0);
  Confinement& c = w.confinement;
  c.surface = 3e-4;
  advance(w);
  c.pressure = 100e6;
  c.rows.clear(), c.weight.clear(), c.force.clear(), c.drifts.clear();
  const double most = 0.1 * 100e6 / std::sqrt(28e9 * 2500.0);
  for (int step = 0; step < 100; ++step) advance(w);
  CHECK(norm(w.particles.velocity[0]) == doctest::Approx(most).epsilon(1e-12));
  record_balance(w.ledger, energy_balance(w));
  CHECK(energy_error(w.ledger) < 1e-6);
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
