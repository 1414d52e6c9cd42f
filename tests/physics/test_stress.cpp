// Stresses from forces, against what acts on the specimen from outside; nearness to failure of
// single bonds; a specimen in a rigid sleeve.
#include <doctest/doctest.h>

#include "core/fields/strain.hpp"
#include "core/fields/stress.hpp"
#include "core/stepping/step.hpp"
#include "core/world/energies.hpp"
#include "core/world/make_world.hpp"
#include "kernels/loops/bond_energy.hpp"
#include "tests/scene.hpp"

using namespace breccia;
namespace ref = breccia::reference;

namespace {

ref::Parameters elastic() {
  ref::Parameters p;
  p.plasticity = p.breakage = false;
  p.alpha = 0.8;
  p.damping_translation = p.damping_rotation = 0.2;
  p.unbonded_contacts = false;
  return p;
}

/// Compressed by 1e-4 of its height, then left until it rests: kinetic under 1e-12 of stored
/// energy.
World compressed(const ref::Parameters& p, std::size_t spheres, bool rough, bool sleeve) {
  WorldOptions o = scene::options(p);
  o.rough_platens = rough, o.rigid_sides = sleeve, o.threads = 2;
  const Assembly a = assemble(scene::small_packing(spheres), scene::small_cylinder(), {}, o.features, 2);
  World w = make_world(a, scene::material_of(p), scene::factor(p), o);
  const int push = 400;
  const double speed = 0.5e-4 * 0.10 / (push * w.dt);
  scene::drive(w, speed, -speed);
  for (int k = 0; k < push; ++k) advance(w);
  scene::drive(w, 0, 0);
  for (int k = 0; k < 40000; ++k) {
    advance(w);
    if (k % 100 == 0 && kinetic_energy(w) < 1e-15 * stored_energy(w)) break;
  }
  REQUIRE(kinetic_energy(w) < 1e-12 * stored_energy(w));
  return w;
}

void hold(const Vec3& a, const Vec3& b, double tolerance) {
  INFO("(", a.x, " ", a.y, " ", a.z, ") (", b.x, " ", b.y, " ", b.z, ")");
  CHECK(norm(a - b) < tolerance);
}

/// What holds a specimen at rest, times where it acts: V sigma, Love's formula. The held particles
/// are pushed by the opposite of what their bonds make.
Stress love(const World& w, const std::vector<Vec3>& from_outside) {
  Stress s;
  for (std::size_t k = 0; k < w.particles.size; ++k) {
    const Vec3 &f = from_outside[k], &x = w.particles.position[k];
    s.normal += (1 / w.volume) * Vec3{f.x * x.x, f.y * x.y, f.z * x.z};
    s.shear += (0.5 / w.volume) * Vec3{f.y * x.z + f.z * x.y, f.z * x.x + f.x * x.z, f.x * x.y + f.y * x.x};
  }
  return s;
}

}  // namespace

TEST_CASE(
    "stress: the mean over the bonds is what holds the specimen - where it holds it [Love at rest normal "
    "1e-8 shear 1e-6]") {
  for (const bool rough : {true, false}) {
    const World w = compressed(elastic(), 500, rough, false);
    const auto f = scene::forces_now(w).force;
    std::vector<Vec3> outside(f.size());
    double most = 0, unrest = 0;
    for (std::size_t k = 0; k < f.size(); ++k) {
      if (k >= w.particles.free)
        outside[k] = -f[k], most = std::max(most, norm(f[k]));
      else
        unrest = std::max(unrest, norm(f[k]));
    }
    REQUIRE(unrest < 1e-6 * most);
    const Stress got = mean_stress_tensor(w), want = love(w, outside);
    const double size = axial_stress(w.platens);
    INFO("rough ", rough, ", platens ", size, ", xx yy zz ", got.normal.x, " ", got.normal.y, " ",
         got.normal.z);
    REQUIRE(size > 1e6);
    MESSAGE(std::string(rough ? "rough" : "smooth"),
            " platens: bonds against reactions where they act: off by ",
            norm(got.normal - want.normal) / size,
            "; against platen stress over the nominal height: ", -got.normal.z / size);
    hold(got.normal, want.normal, 1e-8 * size);
    hold(got.shear, want.shear, 1e-6 * size);  // 3e-8: slow modes of bending still die out
    // platens act on the centres in their layers, not on the nominal ends: a length between
    const double length = -got.normal.z / size * 0.10;
    CHECK(length > 0.10 - 2 * 1.5 * w.particles.radius[0] * 2);
    CHECK(length < 0.10);
    double lever = 0, force = 0;  // mean height of the reactions
    for (std::size_t k = w.particles.free; k < f.size(); ++k)
      lever += std::abs(f[k].z) * std::abs(w.particles.position[k].z), force += std::abs(f[k].z);
    CHECK(length == doctest::Approx(2 * lever / force).epsilon(1e-3));  // (S5.19)
    if (!rough) CHECK(std::abs(got.normal.x) + std::abs(got.normal.y) < 1e-6 * size);
  }
}

TEST_CASE("stress: particles' own stresses have the mean of the specimen by their shares r^3 [1e-12]") {
  World w = compressed(elastic(), 300, true, false);
  w.particles.velocity[5] = {1, 2, 3};  // no matter at rest or not
  for (int k = 0; k < 20; ++k) advance(w);
  fill_stress_columns(w);
  double shares = 0;
  for (std::size_t k = 0; k < w.particles.size; ++k) shares += std::pow(w.particles.radius[k], 3);
  Stress mean;
  for (std::size_t k = 0; k < w.particles.size; ++k) {
    const double part = std::pow(w.particles.radius[k], 3) / shares;
    mean.normal += part * w.particles.stress_normal[k];
    mean.shear += part * w.particles.stress_shear[k];
  }
  const Stress whole = mean_stress_tensor(w);
  hold(mean.normal, whole.normal, 1e-12 * norm(whole.normal));
  hold(mean.shear, whole.shear, 1e-12 * norm(whole.normal));
  CHECK(whole.normal.z < -1e6);
  CHECK(w.bonds.failure_state.empty());  // nothing can fail
}

TEST_CASE("stress: two spheres pressed obliquely: every component in closed form [1e-12]") {
  ref::Parameters p = elastic();
  p.alpha = 1;
  const Vec3 n{2 / 7.0, 3 / 7.0, 6 / 7.0};
  Assembly a = scene::free_body({{1, 0.01, {}}, {2, 0.015, 0.025 * n}}, p.beta, scene::options(p).features);
  World w = make_world(a, scene::material_of(p), scene::factor(p), scene::options(p));
  const double u = -1e-6, F = p.E * std::numbers::pi * 1e-4 / 0.025 * u;
  w.particles.position[1] += u * n;
  const double V = std::numbers::pi / 4, d = 0.025 + u;  // the nominal body of a free one: 1 m by 1 m
  const Stress s = mean_stress_tensor(w);
  hold(s.normal, (F * d / V) * Vec3{n.x * n.x, n.y * n.y, n.z * n.z}, 1e-10 * std::abs(F * d / V));
  hold(s.shear, (F * d / V) * Vec3{n.y * n.z, n.z * n.x, n.x * n.y}, 1e-10 * std::abs(F * d / V));
  // each has its arm of it, in its share of the volume
  fill_stress_columns(w);
  const double share = 1 / (1 + 3.375), arm = d * 0.01 / 0.025;
  hold(w.particles.stress_normal[0], (F * arm / (V * share)) * Vec3{n.x * n.x, n.y * n.y, n.z * n.z},
       1e-10 * std::abs(F * arm / (V * share)));
}

TEST_CASE(
    "stress: failure state of single bonds: F_s/S - u_e/u_nf - the larger - 1 when broken [S5.21 1e-12]") {
  ref::Parameters p;
  p.delta_n = 0.8, p.delta_s = 0.6;
  const double A = 3e-4, d0 = 0.02, k_n = p.E * A / d0, T = p.sigma_t * A, S = p.tau_f * A, u_l = T / k_n;
  const BondConstants<double> bond{d0, A, A, k_n, 0};
  const auto state = [&](const BondHistory<double>& h, double u, bool coupled = false) {
    return failure_state(scene::law(p), bond, h, d0 + u, coupled);
  };
  const auto is = [](double want) { return doctest::Approx(want).epsilon(1e-9); };
  CHECK(state({}, 0) == 0);
  CHECK(state({}, 0.9 * u_l) == is(0.9 / 1.8));
  CHECK(state({{}, 0, 0.5, 0}, 1.4 * u_l) == is(1.4 / 1.8));        // on the softening branch
  CHECK(state({{}, -5 * u_l, 0, 0}, -4.1 * u_l) == is(0.9 / 1.8));  // from its plastic stretch
  CHECK(state({{0, 0.3 * S, 0.4 * S}, 0, 0, 0}, 0) == is(0.5));
  CHECK(state({{0, 0.3 * S, 0.4 * S}, 0, 0, 0}, 0.3 * u_l) == is(0.5));  // the larger one
  CHECK(state({{0, 0.3 * S, 0.4 * S}, 0, 0, 0}, 1.2 * u_l) == is(1.2 / 1.8));
  CHECK(state({{0.5 * S, 0, 0}, 0, 0, 0}, -2 * u_l) ==
        is(0.5 * S / (S + 0.9 * 2 * T)));  // pressure strengthens
  // softened in shear: F_s is g(D) times what the history has
  CHECK(state({{1.3 * S, 0, 0}, 0, 0, 0.5}, 0) == is(0.5));
  CHECK(state({{}, 0, 1, 0}, -u_l) == 1);
  CHECK(state({{}, 0, 0, 1}, 3 * u_l) == 1);
  CHECK(state({{0.1 * S, 0, 0}, 0, 1, 0}, -u_l) == 1);
  p.criterion = ref::Criterion::mohr_coulomb;
  CHECK(state({{0.5 * S, 0, 0}, 0, 0, 0}, 0.5 * u_l) == is(0.5 * S / (S - 0.9 * 0.5 * T)));
  CHECK(failure_state(scene::law(p), {d0, 0, 0, 0, 0}, {}, d0, false) == 0);  // padding
}

TEST_CASE(
    "stress: failure states of a crushed specimen are 1 for the broken and below for the others [exact]") {
  ref::Parameters p;
  p.alpha = 0.8;
  const Assembly a = assemble(scene::small_packing(150), scene::small_cylinder(), {}, Features{}, 1);
  World w = make_world(a, scene::material_of(p), scene::factor(p), scene::options(p));
  scene::drive(w, 6, -6);
  for (int k = 0; k < 250; ++k) advance(w);
  // damages are those of the positions before the last drift
  for (std::size_t k = 0; k < w.particles.size; ++k)
    w.particles.position[k] -= w.dt * w.particles.velocity[k];
  fill_stress_columns(w);
  std::size_t broken = 0;
  double highest = 0;
  for (std::size_t k = 0; k < w.bonds.size; ++k) {
    const bool is = bond_state(w.bonds, k) != BondState::intact;
    broken += is;
    CHECK((w.bonds.failure_state[k] == 1) == is);
    CHECK(w.bonds.failure_state[k] >= 0);
    if (!is) highest = std::max(highest, w.bonds.failure_state[k]);
  }
  CHECK(broken > 20);
  CHECK(highest > 0.5);
}

TEST_CASE(
    "sleeve: the lateral surface does not move sideways - its pressure is the lateral stress of the network "
    "[(B73) "
    "Love 1e-6]") {
  const World w = compressed(elastic(), 500, false, true);
  const auto f = scene::forces_now(w).force;
  double sideways = 0, reaction = 0, radial = 0, inner = 0;
  for (std::size_t k = 0; k < w.particles.size; ++k) {
    const Vec3 u = w.particles.position[k] - w.particles.reference_position[k], &x = w.particles.position[k];
    const bool skin =
        std::binary_search(w.confinement.rows.begin(), w.confinement.rows.end(), static_cast<Row>(k));
    if (!skin) {
      inner = std::max(inner, std::hypot(u.x, u.y));
      continue;
    }
    sideways = std::max(sideways, std::hypot(u.x, u.y));
    reaction += (x.x * f[k].x + x.y * f[k].y) / std::hypot(x.x, x.y);
    radial -= x.x * f[k].x + x.y * f[k].y;
  }
  CHECK(sideways == 0);
  CHECK(inner > 1e-9);  // the others do
  const double pressure = w.confinement.pressure, axial = axial_stress(w.platens);
  CHECK(pressure == doctest::Approx(reaction / (std::numbers::pi * 0.05 * 0.10)).epsilon(1e-6));
  // only the sleeve acts along x and y (platens are smooth): V (xx + yy) is its moment
  const Stress s = mean_stress_tensor(w);
  CHECK(w.volume * (s.normal.x + s.normal.y) == doctest::Approx(radial).epsilon(1e-6));
  CHECK(std::abs(s.normal.x - s.normal.y) < 0.1 * std::abs(s.normal.x + s.normal.y));
  MESSAGE("lateral over axial stress: ", s.normal.x / s.normal.z, " ", s.normal.y / s.normal.z,
          ", at the walls ", pressure / axial);
  // uniaxial strain: nu/(1 - nu) of the affine network, nu = (1 - kappa)/(4 + kappa)
  const double kappa = w.shear_ratio.front(), nu = (1 - kappa) / (4 + kappa);
  CHECK(0.5 * (s.normal.x + s.normal.y) / s.normal.z == doctest::Approx(nu / (1 - nu)).epsilon(0.08));
}

TEST_CASE(
    "strain: a linear displacement has its gradient at every particle, a band its share of the volume "
    "[(S5.20) 1e-12, (B114)]") {
  const reference::Parameters p;
  WorldOptions o = scene::options(p);
  const Assembly a = assemble(scene::small_packing(500), scene::small_cylinder(), {}, o.features, 1);
  World w = make_world(a, scene::material_of(p), scene::factor(p), o);
  ParticleTable& t = w.particles;
  for (std::size_t k = 0; k < t.size; ++k) {
    const Vec3& x = t.reference_position[k];
    t.position[k] = x + Vec3{2e-3 * x.x + 4e-3 * x.y, 1e-3 * x.z, -5e-3 * x.z + 3e-3 * x.x};
  }
  std::size_t measured = 0;
  for (const Strain& e : strains(w)) {
    if (e.normal == Vec3{}) continue;  // two bonds span no space
    ++measured;
    CHECK(norm(e.normal - Vec3{2e-3, 0, -5e-3}) < 1e-14);
    CHECK(norm(e.shear - Vec3{0.5e-3, 1.5e-3, 2e-3}) < 1e-14);
  }
  CHECK(measured > 450);
  CHECK(localisation(w) == doctest::Approx(0.9).epsilon(0.01));
  // all of it sheared off in a band of 15 mm of 100: and the neighbourhoods that reach into it
  for (std::size_t k = 0; k < t.size; ++k) {
    const Vec3& x = t.reference_position[k];
    t.position[k] = x + Vec3{1e-3 * std::clamp(x.z / 0.015, -0.5, 0.5), 0, 0};
  }
  CHECK(localisation(w) > 0.12);
  CHECK(localisation(w) < 0.3);
  fill_stress_columns(w);
  CHECK(w.bonds.normal_force.size() == w.bonds.padded);
  for (std::size_t k = 0; k < w.bonds.size; ++k)
    CHECK(w.bonds.normal_stress[k] * w.bonds.area[k] ==
          doctest::Approx(w.bonds.normal_force[k]).epsilon(1e-12));
}
