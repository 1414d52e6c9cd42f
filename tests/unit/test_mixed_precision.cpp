// Mixed precision: the same run with the bonds' parameters and history as floats.
#include <doctest/doctest.h>

#include "core/stepping/step.hpp"
#include "core/world/energies.hpp"
#include "core/world/make_world.hpp"
#include "core/world/sync.hpp"
#include "tests/scene.hpp"

using namespace breccia;
namespace ref = breccia::reference;

namespace {

World crushed(Precision precision, int steps, double speed, InstructionSet set, int threads = 1) {
  ref::Parameters p;
  p.alpha = 0.8;
  const Assembly a = assemble(scene::small_packing(150), scene::small_cylinder(), {}, Features{}, 1);
  WorldOptions o = scene::options(p);
  o.precision = precision;
  o.instruction_set = set;
  o.threads = threads;
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

TEST_CASE("mixed precision: intact bonds move particles as in full precision to a float's round-off [1e-6]") {
  for (const InstructionSet set : scene::sets_of_this_machine()) {
    const World full = crushed(Precision::full, 200, 0.05, set),
                mixed = crushed(Precision::mixed, 200, 0.05, set);
    REQUIRE(count_broken(full).tension + count_broken(full).shear == 0);
    const double difference = apart(full, mixed);
    CHECK(difference < 1e-6);
    CHECK(difference > 1e-12);  // floats did run
    CHECK(stored_energy(mixed) == doctest::Approx(stored_energy(full)).epsilon(1e-5));
  }
}

TEST_CASE("mixed precision: what breaks is recorded and seen in the table of bonds") {
  const World full = crushed(Precision::full, 150, 6, best_instruction_set()),
              mixed = crushed(Precision::mixed, 150, 6, best_instruction_set(), 2);
  const BrokenCount want = count_broken(full), got = count_broken(mixed);
  REQUIRE(want.tension > 20);
  CHECK(got.tension + got.shear == mixed.cracks.cracks.size());
  CHECK(static_cast<double>(got.tension) == doctest::Approx(static_cast<double>(want.tension)).epsilon(0.02));
  CHECK(stored_energy(mixed) == doctest::Approx(stored_energy(full)).epsilon(0.02));
  const auto released = [](const World& w) {
    double sum = 0;
    for (const Crack& c : w.cracks.cracks) sum += c.energy;
    return sum;
  };
  CHECK(released(mixed) == doctest::Approx(released(full)).epsilon(0.02));
}

TEST_CASE("mixed precision: built for the Dempack law alone") {
  ref::Parameters p;
  const BondLaw law = scene::law(p);
  CHECK(built_features(law, {.rotation = false}, {Precision::mixed}) == Features{});
  CHECK_THROWS(built_features(law, {.criterion = Criterion::coupled}, {Precision::mixed}));
  CHECK_THROWS(bond_pass_for(law, {.rotation = false}, InstructionSet::x86_64, {Precision::mixed}));
}
