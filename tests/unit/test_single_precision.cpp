// Single precision: the same run in floats and integers.
#include <doctest/doctest.h>

#include "core/stepping/step.hpp"
#include "core/tables/state_hash.hpp"
#include "core/world/energies.hpp"
#include "core/world/energy_accounting.hpp"
#include "core/world/make_world.hpp"
#include "core/world/single_precision.hpp"
#include "core/world/sync.hpp"
#include "tests/scene.hpp"

using namespace breccia;
namespace ref = breccia::reference;

namespace {

World crushed(Precision precision, int steps, double speed, InstructionSet set, int threads = 1,
              ScatterKind scatter = ScatterKind::private_sums, bool ledger = false) {
  ref::Parameters p;
  p.alpha = 0.8;
  const Assembly a = assemble(scene::small_packing(150), scene::small_cylinder(), {}, Features{}, 1);
  WorldOptions o = scene::options(p);
  o.precision = precision;
  o.instruction_set = set;
  o.threads = threads;
  o.scatter = scatter;
  o.ledger = ledger;
  World w = make_world(a, scene::material_of(p), scene::factor(p), o);
  for (int k = 0; k < steps; ++k) {
    scene::drive(w, speed, -speed);
    advance(w);
  }
  sync(w);
  return w;
}

/// Largest difference of the displacements, over the largest displacement.
double apart(const World& a, const World& b) {
  double most = 0, difference = 0;
  for (std::size_t k = 0; k < a.particles.size; ++k) {
    const Vec3 start = a.particles.reference_position[k];
    most = std::max(most, norm(a.particles.position[k] - start));
    difference = std::max(difference, norm(a.particles.position[k] - b.particles.position[k]));
  }
  return difference / most;
}

}  // namespace

TEST_CASE(
    "single precision: intact bonds move particles as in full precision to a float's round-off [2e-6]") {
  for (const InstructionSet set : scene::sets_of_this_machine()) {
    const World full = crushed(Precision::full, 200, 0.05, set),
                single = crushed(Precision::single, 200, 0.05, set);
    REQUIRE(count_broken(full).tension + count_broken(full).shear == 0);
    const double difference = apart(full, single);
    CHECK(difference < 2e-6);
    CHECK(difference > 1e-12);  // floats did run
    CHECK(stored_energy(single) == doctest::Approx(stored_energy(full)).epsilon(1e-5));
  }
}

TEST_CASE("single precision: what breaks is recorded and seen in the table of bonds") {
  const World full = crushed(Precision::full, 150, 6, best_instruction_set()),
              single = crushed(Precision::single, 150, 6, best_instruction_set(), 2);
  const BrokenCount want = count_broken(full), got = count_broken(single);
  REQUIRE(want.tension > 20);
  CHECK(got.tension + got.shear == single.cracks.cracks.size());
  CHECK(static_cast<double>(got.tension) == doctest::Approx(static_cast<double>(want.tension)).epsilon(0.02));
  CHECK(stored_energy(single) == doctest::Approx(stored_energy(full)).epsilon(0.02));
  const auto released = [](const World& w) {
    double sum = 0;
    for (const Crack& c : w.cracks.cracks) sum += c.energy;
    return sum;
  };
  CHECK(released(single) == doctest::Approx(released(full)).epsilon(0.02));
}

TEST_CASE("single precision: built for every law but that of cement with moments") {
  ref::Parameters p;
  const BondLaw law = scene::law(p);
  CHECK(built_features(law, {.rotation = false}, {Precision::single}) == Features{});
  CHECK(built_features(law, {.criterion = Criterion::coupled}, {Precision::single}).criterion ==
        Criterion::coupled);
  CHECK_THROWS(single_pass_for(law, {.rotation = false}, InstructionSet::x86_64));
  CHECK_THROWS(built_features(ParallelBondLaw{}, {.plasticity = false}, {Precision::single}));
}

TEST_CASE(
    "single precision: the same bits for any number of threads, ways of summing, and on AVX2 and AVX-512") {
  std::string hash;
  std::size_t broken = 0;
  for (const InstructionSet set : scene::sets_of_this_machine()) {
    if (set == InstructionSet::x86_64) continue;  // it fuses no products in the integration
    for (const auto& [threads, scatter] : {std::pair{1, ScatterKind::private_sums},
                                           {2, ScatterKind::private_sums},
                                           {3, ScatterKind::private_sums},
                                           {3, ScatterKind::atomic},
                                           {2, ScatterKind::gather}}) {
      const World w = crushed(Precision::single, 400, 6, set, threads, scatter);
      const std::string now = state_hash(w.particles, w.bonds);
      if (hash.empty()) hash = now;
      broken = count_broken(w).tension + count_broken(w).shear;
      CHECK(now == hash);
    }
  }
  if (!hash.empty()) CHECK(broken > 100);
}

TEST_CASE("single precision: the energy ledger closes, and its books are those of doubles [1e-4, 2 %]") {
  const World single = crushed(Precision::single, 300, 3, best_instruction_set(), 1,
                               ScatterKind::private_sums, true),
              full = crushed(Precision::full, 300, 3, best_instruction_set(), 1, ScatterKind::private_sums,
                             true);
  const EnergyBalance ours = energy_balance(single), theirs = energy_balance(full);
  REQUIRE(theirs.damage > 0);
  REQUIRE(theirs.plastic > 0);
  CHECK(std::abs(ours.work - ours.kinetic - ours.stored - ours.dissipated()) < 1e-4 * ours.work);
  for (const auto part :
       {&EnergyBalance::work, &EnergyBalance::stored, &EnergyBalance::plastic, &EnergyBalance::damage,
        &EnergyBalance::contact_viscous, &EnergyBalance::global_damping})
    CHECK(ours.*part == doctest::Approx(theirs.*part).epsilon(0.02));
}

TEST_CASE("single precision: fragments that fly metres away, and come back, move as in doubles") {
  // four spheres: a bonded pair that flies, with one beside it whose bond is broken, and one that
  // stays
  const auto flown = [](Precision precision, int steps, int turn_at) {
    ref::Parameters p;
    p.damping_translation = p.damping_rotation = 0;
    const double r = 0.005;
    const Vec3 away{12, 2, -1};
    Assembly a = scene::free_body({{1, r, {0, 0, 0}},
                                   {2, r, {2 * r, 0, 0}},
                                   {3, r, {4 * r, 0, 0}, 1, away},
                                   {4, r, {6 * r, 0, 0}, 1, away}},
                                  0.1, Features{});
    WorldOptions o = scene::options(p);
    o.precision = precision;
    World w = make_world(a, scene::material_of(p), scene::factor(p), o);
    BondTable& b = w.bonds;
    for (std::size_t k = 0; k < b.size; ++k)
      if (b.gid_lo[k] == 2) b.damage_normal[k] = 1.0;
    fill_single(w);
    for (int k = 0; k < steps; ++k) {
      advance(w);
      if (k == turn_at)
        for (Row row : {2u, 3u}) w.particles.velocity[row] = -1.07 * w.particles.velocity[row];
    }
    sync(w);
    return w;
  };
  const int out = 150000;
  const World far = flown(Precision::single, out, 0x7fffffff);
  CHECK(norm(far.particles.position[2]) > 1.0);
  CHECK(far.single.renewals > 20);
  const World single = flown(Precision::single, 2 * out + 100, out),
              full = flown(Precision::full, 2 * out + 100, out);
  CHECK(norm(full.particles.position[2]) < 0.1);  // it has come back, and met the two that stayed
  CHECK(norm(full.particles.velocity[1]) > 1.0);
  for (Row row = 0; row < 4; ++row) {
    CHECK(norm(single.particles.position[row] - full.particles.position[row]) < 1e-6);
    CHECK(norm(single.particles.velocity[row] - full.particles.velocity[row]) < 1e-3 * 12);
  }
}

TEST_CASE(
    "single precision: what spins faster and faster makes its quantum coarser, and spins as in doubles "
    "[1e-4]") {
  // the spheres of a broken pair slide on each other while something turns one of them
  const auto spun = [](Precision precision) {
    ref::Parameters p;
    p.damping_translation = p.damping_rotation = 0;
    const double r = 0.005;
    const Assembly a =
        scene::free_body({{1, r, {0, 0, 0}}, {2, r, {1.999 * r, 0, 0}, 1, {-5, 0, 0}}}, 0.1, Features{});
    WorldOptions o = scene::options(p);
    o.precision = precision;
    World w = make_world(a, scene::material_of(p), scene::factor(p), o);
    w.bonds.damage_normal[0] = 1.0;
    fill_single(w);
    for (int k = 0; k < 200; ++k) {
      w.particles.spin[0] += Vec3{0, 0, 300};
      advance(w);
    }
    return w;
  };
  const World single = spun(Precision::single), full = spun(Precision::full);
  CHECK(norm(full.particles.spin[0]) > 2e4);
  CHECK(single.single.quanta.motion > single.single.quanta.length);
  CHECK(single.single.coarsenings > 1);
  for (const std::size_t row : {0u, 1u}) {
    const auto same = [](const Vec3& a, const Vec3& b) { CHECK(norm(a - b) <= 1e-4 * norm(b)); };
    same(single.particles.spin[row], full.particles.spin[row]);
    same(single.particles.velocity[row], full.particles.velocity[row]);
  }
}

TEST_CASE("single precision: a scene with a bond too short for it runs in doubles") {
  for (const double apart : {1e-8, 1e-3}) {
    ref::Parameters p;
    const double r = 0.005;
    const Assembly a = scene::free_body(
        {{1, r, {0, 0, 0}}, {2, r, {apart, 0, 0}}, {3, r, {2 * r, 0, 0}}, {4, r, {4 * r, 0, 0}}}, 0.1,
        Features{});
    WorldOptions o = scene::options(p);
    o.precision = Precision::single;
    World w = make_world(a, scene::material_of(p), scene::factor(p), o);
    CHECK(bond_too_short_for_single(a.bonds).has_value() == (apart < 1e-6));
    CHECK(w.options.precision == (apart < 1e-6 ? Precision::full : Precision::single));
    CHECK(w.single.empty() == (apart < 1e-6));
    advance(w);
  }
}
