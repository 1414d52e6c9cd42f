// The parallel bond: moments, their stiffness in the probe and in the step, breaking, energy
// (docs/model.md, B123, B124).
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "core/elastic/critical_step.hpp"
#include "core/elastic/elastic_network.hpp"
#include "core/loading/load_test.hpp"
#include "core/stepping/step.hpp"
#include "core/world/energies.hpp"
#include "core/world/energy_accounting.hpp"
#include "tests/scene.hpp"

using namespace breccia;

namespace {

constexpr double r = 0.01, young = 1e9, kappa = 0.4, strength = 5e6, cohesion = 20e6;

Material cement(double factor = 1.0) {
  Material m;
  m.law = "parallel-bond";
  m.density = 2500, m.young_modulus = young, m.poisson_ratio = 0.25;
  m.friction_static = 0.5, m.friction_dynamic = 0.3;
  m.tensile_strength = strength, m.shear_strength = cohesion;
  m.own["moment_factor"] = factor;
  return m;
}

WorldOptions no_damping() {
  WorldOptions o;
  o.features = {.contact_damping = false, .plasticity = false};
  o.contact_damping = 0, o.global_damping = {0, 0};
  o.ledger = true;
  return o;
}

/// Two equal spheres along x, free, spinning against each other by half of `spin` each.
World pair(const Vec3& spin, double factor = 1.0) {
  const Features columns =
      built_features(law_of(cement(), kappa), no_damping().features, {Precision::full, true});
  Assembly a = scene::free_body(
      {{1, r, {-r, 0, 0}, 1, {}, -0.5 * spin}, {2, r, {r, 0, 0}, 1, {}, 0.5 * spin}}, 0.1, columns);
  a.cement = true;
  AreaFactor f;
  f.alpha = 1, f.shear_ratio = kappa;
  World w = make_world(a, cement(factor), f, no_damping());
  w.dt = 1e-8;  // spheres hardly answer within a few steps
  return w;
}

const double area = std::numbers::pi * r * r, k_n = young * area / (2 * r);
const double k_bend = k_n * r * r / 4, k_twist = kappa * k_n * r * r / 2;

}  // namespace

TEST_CASE(
    "parallel bond: bending and twisting moments are k_n I/A and k_s J/A times the angle [(B123), 1e-6]") {
  for (const auto& [axis, stiffness] : {std::pair{Vec3{0, 1, 0}, k_bend}, {Vec3{1, 0, 0}, k_twist}}) {
    World w = pair(10.0 * axis);
    double angle = 0;
    for (int k = 0; k < 100; ++k)
      angle += w.dt * dot(axis, w.particles.spin[1] - w.particles.spin[0]), advance(w);
    CHECK(norm(w.bonds.couple[0] - (stiffness * angle) * axis) < 1e-6 * stiffness * angle);
    CHECK(stored_energy(w) == doctest::Approx(0.5 * stiffness * angle * angle).epsilon(1e-5));
  }
}

TEST_CASE("parallel bond: it tears at sigma_t by bending, is sheared at tau_f by twisting [(B124), 1e-3]") {
  // 4 M/R = sigma A and 2 M/R = tau A
  const double torn = strength * area * r / (4 * k_bend), sheared = cohesion * area * r / (2 * k_twist);
  for (const bool bends : {true, false}) {
    const double wanted = bends ? torn : sheared;
    World w = pair(1e5 * (bends ? Vec3{0, 1, 0} : Vec3{1, 0, 0}), 1.0);
    double angle = 0;
    while (bond_state(w.bonds, 0) == BondState::intact && angle < 2 * wanted)
      angle += w.dt * norm(w.particles.spin[1] - w.particles.spin[0]), advance(w);
    CHECK(angle == doctest::Approx(wanted).epsilon(1e-3));
    CHECK(bond_state(w.bonds, 0) == (bends ? BondState::broken_tension : BondState::broken_shear));
    CHECK(w.bonds.couple[0] == Vec3{});
    World whole = pair(1e5 * (bends ? Vec3{0, 1, 0} : Vec3{1, 0, 0}), 0.0);  // moments that count for nothing
    for (double turned = 0; turned < 2 * wanted; turned += whole.dt * 1e5) advance(whole);
    CHECK(bond_state(whole.bonds, 0) == BondState::intact);
  }
}

TEST_CASE("parallel bond: the network knows moments: none in a rigid turn, exact in a bend [1e-12]") {
  const World w = pair({});
  const auto constants = [&](std::size_t) { return SpringConstants{k_n, kappa * k_n, k_bend, k_twist}; };
  const ElasticNetwork net = elastic_network(w.particles, w.bonds, w.contacts, true, 1, constants);
  Eigen::VectorXd u(12), force(12);
  std::vector<SpringLoad<double>> loads;
  const Vec3 turn{0.3, -0.2, 0.5};
  for (int k = 0; k < 2; ++k) {
    const Vec3 x = cross(turn, w.particles.position[k]);
    u.segment<6>(6 * k) << x.x, x.y, x.z, turn.x, turn.y, turn.z;
  }
  apply_stiffness(net, u, loads, force);
  CHECK(force.cwiseAbs().maxCoeff() < 1e-12 * k_n);
  u.setZero();
  u.segment<3>(3) << -0.5 * 0.2, -0.5 * 0.1, 0;
  u.segment<3>(9) << 0.5 * 0.2, 0.5 * 0.1, 0;
  apply_stiffness(net, u, loads, force);
  CHECK(std::abs(force[9] - k_twist * 0.2) < 1e-12 * k_twist);
  CHECK(std::abs(force[10] - k_bend * 0.1) < 1e-12 * k_bend);
  CHECK(std::abs(force[3] + k_twist * 0.2) < 1e-12 * k_twist);
}

TEST_CASE("parallel bond: the critical step of a pair counts its twisting mode [closed form, 1e-6]") {
  World w = pair({});
  w.bonds.area[0] *= 30;  // a collar so wide that twisting is the fastest
  const double twist = kappa * k_n * (30 * r * r) / 2, inertia = 0.4 * w.particles.mass[0] * r * r;
  const StepScene s{
      w.particles, w.bonds, w.contacts, w.dashpots, {&kappa, 1}, 0, 0, {true, false, 0.4, true}, 1};
  CHECK(exact_time_step(s) == doctest::Approx(2 / std::sqrt(2 * twist / inertia)).epsilon(1e-6));
}

TEST_CASE("parallel bond: a cylinder that breaks keeps its books, with the square of the step") {
  const Features columns =
      built_features(law_of(cement(), kappa), no_damping().features, {Precision::full, true});
  Assembly a = assemble(scene::small_packing(400), scene::small_cylinder(), {}, columns, 1);
  a.cement = true;
  const auto error = [&](double safety, int threads, ScatterKind scatter) {
    WorldOptions o = no_damping();
    o.global_damping = {0.1, 0.1}, o.safety = safety, o.threads = threads, o.scatter = scatter;
    AreaFactor f;
    f.alpha = 0.8, f.shear_ratio = kappa;
    Material stiff = cement();
    stiff.young_modulus = 20 * young;
    World w = make_world(a, stiff, f, o);
    LoadTest test;
    test.platen_speed = 0.2, test.stop_strain = 0.01, test.frames = 0;
    LoadResult result;
    run_load_test(w, a, test, {}, result);
    CHECK(count_broken(w).tension > 100);
    return std::pair(energy_error(w.ledger), energy_balance(w).failure);
  };
  const auto [coarse, failed] = error(0.8, 1, ScatterKind::gather);
  CHECK(coarse < 1e-3);
  CHECK(failed > 0.0);
  CHECK(error(0.2, 1, ScatterKind::gather).first < 0.25 * coarse);
  CHECK(error(0.8, 2, ScatterKind::gather) == std::pair(coarse, failed));  // the same bits
}
