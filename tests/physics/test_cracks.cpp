// The record of cracks: every bond that breaks, once, when it breaks, with what it carried and let
// go.
#include <doctest/doctest.h>

#include "core/stepping/step.hpp"
#include "core/world/energies.hpp"
#include "core/world/make_world.hpp"
#include "tests/scene.hpp"

using namespace breccia;
namespace ref = breccia::reference;
using scene::Ball;

namespace {

using GidPair = std::pair<Gid, Gid>;

World crushed(ScatterKind scatter, int threads, const Features& asked = {}, bool record = true) {
  ref::Parameters p;
  p.alpha = 0.8;
  p.criterion = static_cast<ref::Criterion>(asked.criterion);
  WorldOptions o = scene::options(p);
  o.features = asked;
  o.scatter = scatter, o.threads = threads, o.cracks = record;
  const Assembly a = assemble(scene::small_packing(150), scene::small_cylinder(), {},
                              built_features(scene::law(p), asked), 1);
  World w = make_world(a, scene::material_of(p), scene::factor(p), o);
  scene::drive(w, 6, -6);
  return w;
}

/// Two held spheres, the upper one drawn away along z, or along x; touching, r = 10 mm.
World pulled_pair(const ref::Parameters& p, const Vec3& velocity) {
  Assembly a = scene::free_body({{8, 0.01, {0, 0, -0.01}}, {3, 0.01, {0, 0, 0.01}}}, p.beta,
                                scene::options(p).features);
  a.particles.free = 0, a.first_top = 1;
  World w = make_world(a, scene::material_of(p), scene::factor(p), scene::options(p));
  w.platens.velocity = {Vec3{}, velocity};
  w.particles.velocity[1] = velocity;
  return w;
}

constexpr double speed = 2e-3;  // m/s

ref::Parameters brittle() {
  ref::Parameters p;
  p.delta_n = p.delta_s = 0;
  p.contact_damping = p.plasticity = false;
  p.xi = 0;
  return p;
}

}  // namespace

TEST_CASE(
    "cracks: a crushed specimen: every broken bond is in the record once - at its step - in order of time "
    "[equal]") {
  for (const Features& asked :
       {Features{}, Features{.criterion = Criterion::coupled}, Features{.plasticity = false}})
    for (const auto& [scatter, threads] : {std::pair{ScatterKind::private_sums, 1},
                                           {ScatterKind::private_sums, 2},
                                           {ScatterKind::gather, 3}}) {
      World w = crushed(scatter, threads, asked);
      const double inner_step = w.dt;
      std::map<GidPair, std::pair<double, BondState>> want;
      for (int k = 0; k < 400; ++k) {
        const double now = w.time;
        CHECK(now == doctest::Approx(k * inner_step).epsilon(1e-9));
        advance(w);
        for (std::size_t b = 0; b < w.bonds.size; ++b)
          if (const BondState state = bond_state(w.bonds, b); state != BondState::intact)
            want.try_emplace({w.bonds.gid_lo[b], w.bonds.gid_hi[b]}, now, state);
      }
      const BrokenCount broken = count_broken(w);
      REQUIRE(broken.tension > 20);
      REQUIRE(broken.shear > 5);
      CHECK(w.cracks.missed == 0);
      CHECK(w.cracks.cracks.size() == broken.tension + broken.shear);
      std::set<GidPair> seen;
      int wrong = 0;
      double before = 0;
      for (const Crack& c : w.cracks.cracks) {
        wrong += !seen.insert({c.gid_lo, c.gid_hi}).second;
        const auto at = want.find({c.gid_lo, c.gid_hi});
        wrong += at == want.end() || at->second != std::pair{c.time, c.mode};
        wrong += !(c.time >= before) || !(c.gid_lo < c.gid_hi);
        wrong += !(std::abs(norm(c.normal) - 1) < 1e-12);
        before = c.time;
      }
      CHECK(wrong == 0);
      CHECK(seen.size() == want.size());
    }
}

TEST_CASE(
    "cracks: gather gives the same record for 1 and 2 and 3 threads - a switched off record is empty [equal "
    "bits]") {
  const auto run = [](int threads, bool record) {
    World w = crushed(ScatterKind::gather, threads, {}, record);
    for (int k = 0; k < 400; ++k) advance(w);
    return w;
  };
  const World one = run(1, true);
  REQUIRE(one.cracks.cracks.size() > 30);
  for (const int threads : {2, 3}) {
    const World w = run(threads, true);
    REQUIRE(w.cracks.cracks.size() == one.cracks.cracks.size());
    for (std::size_t k = 0; k < one.cracks.cracks.size(); ++k) {
      const Crack &a = one.cracks.cracks[k], &b = w.cracks.cracks[k];
      CHECK(std::tie(a.time, a.gid_lo, a.gid_hi, a.mode, a.normal_force, a.shear_force, a.area, a.energy) ==
            std::tie(b.time, b.gid_lo, b.gid_hi, b.mode, b.normal_force, b.shear_force, b.area, b.energy));
      CHECK(a.position == b.position);
      CHECK(a.normal == b.normal);
    }
  }
  const World none = run(2, false);
  CHECK(none.cracks.cracks.empty());
  CHECK(count_broken(none).tension == count_broken(one).tension);
}

TEST_CASE(
    "cracks: a pair torn apart: force sigma_t A to one step - energy F^2/(2 k_n) - place - direction [closed "
    "form]") {
  const ref::Parameters p = brittle();
  World w = pulled_pair(p, {0, 0, speed});
  const double A = std::numbers::pi * 1e-4, k_n = p.E * A / 0.02, T = p.sigma_t * A,
               step = k_n * speed * w.dt;
  REQUIRE(step < 0.01 * T);
  for (int k = 0; k < int(3 * T / step); ++k) advance(w);
  REQUIRE(w.cracks.cracks.size() == 1);
  const Crack& c = w.cracks.cracks[0];
  CHECK(c.mode == BondState::broken_tension);
  CHECK(c.normal_force <= T);
  CHECK(c.normal_force > T - step * (1 + 1e-6));
  CHECK(c.shear_force < 1e-15 * c.normal_force);  // round-off of the normal
  CHECK(c.area == doctest::Approx(A).epsilon(1e-14));
  CHECK(c.energy == doctest::Approx(0.5 * c.normal_force * c.normal_force / k_n).epsilon(1e-9));
  CHECK(c.energy == doctest::Approx(0.5 * T * T / k_n).epsilon(2 * step / T));
  const double stretch = T / k_n;  // the first step of the pass sees no motion yet
  CHECK(c.time == doctest::Approx(stretch / speed).epsilon(step / T));
  // ends by their ids: 3 is the upper sphere
  CHECK(std::pair(c.gid_lo, c.gid_hi) == GidPair{3, 8});
  CHECK(norm(c.normal - Vec3{0, 0, -1}) < 1e-12);
  CHECK(norm(c.position - Vec3{0, 0, 0.5 * stretch}) < 1e-6 * 0.02);
}

TEST_CASE(
    "cracks: a pair sheared apart - in the open: force tau_f A to one step - energy F^2/(2 k_s) [closed "
    "form]") {
  ref::Parameters p = brittle();
  p.tau_f = 2e6;  // breaks while the pair has hardly turned
  World w = pulled_pair(p, {speed, 0, 0});
  w.particles.mass.assign(2, 1e9);  // held, and too heavy to roll
  const double A = std::numbers::pi * 1e-4, k_s = p.E * A / 0.02 / 2.4, S = p.tau_f * A,
               step = k_s * speed * w.dt;
  REQUIRE(step < 0.01 * S);
  for (int k = 0; k < int(2 * S / step); ++k) advance(w);
  REQUIRE(w.cracks.cracks.size() == 1);
  const Crack& c = w.cracks.cracks[0];
  CHECK(c.mode == BondState::broken_shear);
  CHECK(c.shear_force <= S);
  CHECK(c.shear_force > S - step * (1 + 1e-4));
  CHECK(c.energy == doctest::Approx(0.5 * c.shear_force * c.shear_force / k_s).epsilon(1e-3));
  CHECK(std::abs(c.normal_force) < 0.01 * S);
}

TEST_CASE(
    "cracks: softening first: the crack comes at u_l (1 + delta) with next to no force and energy [closed "
    "form]") {
  ref::Parameters p = brittle();
  p.delta_n = 0.8;
  World w = pulled_pair(p, {0, 0, speed});
  const double A = std::numbers::pi * 1e-4, k_n = p.E * A / 0.02, T = p.sigma_t * A,
               step = k_n * speed * w.dt;
  for (int k = 0; k < int(3 * T / step); ++k) advance(w);
  REQUIRE(w.cracks.cracks.size() == 1);
  const Crack& c = w.cracks.cracks[0];
  CHECK(c.time == doctest::Approx(1.8 * T / k_n / speed).epsilon(step / T));
  CHECK(c.normal_force >= 0);
  CHECK(c.normal_force < step / 0.8 * 1.01);  // the branch falls by 1/delta of the rise
  CHECK(c.energy ==
        doctest::Approx(0.5 * c.normal_force * 1.8 * T / k_n).epsilon(2 * step / T));  // 1/2 F u, secant
}
