// Single precision over many steps: what is at rest stays there, what vibrates keeps its energy.
#include <doctest/doctest.h>

#include <cstdlib>
#include <random>

#include "core/world/energies.hpp"
#include "core/world/energy_accounting.hpp"
#include "core/world/sync.hpp"
#include "tests/scene.hpp"

using namespace breccia;
namespace ref = breccia::reference;

namespace {

World specimen(Precision precision, double contact_damping, double global_damping) {
  ref::Parameters p;
  p.alpha = 0.8;
  const Assembly a = assemble(scene::small_packing(150), scene::small_cylinder(), {}, Features{}, 1);
  WorldOptions o = scene::options(p);
  o.precision = precision;
  o.contact_damping = contact_damping;
  o.global_damping = {global_damping, global_damping};
  o.new_contacts = false;
  o.ledger = true;
  return make_world(a, scene::material_of(p), scene::factor(p), o);
}

double axial_force(const World& w) { return 0.5 * (w.platens.force[1].z - w.platens.force[0].z); }

struct Means {
  double energy = 0, force = 0, stored = 0, kinetic = 0;
};

/// Over steps.
Means means_of(World& w, int steps) {
  Means m;
  for (int k = 0; k < steps; ++k) {
    advance(w);
    if (k % 10 != 0) continue;
    sync(w);
    const EnergyBalance e = energy_balance(w);
    m.energy += e.kinetic + e.stored, m.stored += e.stored, m.kinetic += e.kinetic;
    m.force += axial_force(w);
  }
  const double count = steps / 10;
  return {m.energy / count, m.force / count, m.stored / count, m.kinetic / count};
}

}  // namespace

// Forces that are rounded to a quantum push at random; the quantum is so fine that doubles drift as
// much.
TEST_CASE(
    "single precision: an undamped vibration keeps its energy over 1e5 steps [drift 2e-4, as doubles]") {
  const auto drift = [](Precision precision) {
    World w = specimen(precision, 0.0, 0.0);
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (std::size_t row = 0; row < w.particles.free; ++row)
      w.particles.velocity[row] = {0.05 * uniform(random), 0.05 * uniform(random), 0.05 * uniform(random)};
    means_of(w, 100);
    const Means first = means_of(w, 5000);
    for (int k = 0; k < 90000; ++k) advance(w);
    const Means last = means_of(w, 5000);
    REQUIRE(count_broken(w).tension == 0);
    REQUIRE(first.kinetic > 0.2 * first.energy);
    return last.energy / first.energy - 1.0;
  };
  const double in_doubles = drift(Precision::full), single = drift(Precision::single);
  CHECK(std::abs(in_doubles) < 2e-4);
  CHECK(std::abs(single) < 2e-4);
}

TEST_CASE("single precision: a pressed specimen at rest stays there for 1e5 steps [1e-6, no trend]") {
  World w = specimen(Precision::single, 0.9, 0.1);
  for (int k = 0; k < 500; ++k) {
    scene::drive(w, 0.01, -0.01);
    advance(w);
  }
  scene::drive(w, 0, 0);
  for (int k = 0; k < 20000; ++k) advance(w);
  const Means first = means_of(w, 1000);
  // BRECCIA_REPEAT = 10: 1e6 steps
  const char* times = std::getenv("BRECCIA_REPEAT");
  for (int k = 98000 * (times ? std::atoi(times) : 1); k > 0; --k) advance(w);
  const Means last = means_of(w, 1000);
  REQUIRE(count_broken(w).tension == 0);
  REQUIRE(first.force > 100.0);
  CHECK(last.force == doctest::Approx(first.force).epsilon(1e-6));
  CHECK(last.stored == doctest::Approx(first.stored).epsilon(1e-6));
  CHECK(last.kinetic < 1e-10 * last.stored);
  MESSAGE("force ", last.force / first.force - 1.0, ", stored ", last.stored / first.stored - 1.0,
          " apart; kinetic over stored ", last.kinetic / last.stored);
}
