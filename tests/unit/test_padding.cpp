// The bond loop works on whole batches: the bonds that fill up the last one must never be felt.
#include <doctest/doctest.h>

#include <cmath>

#include "core/stepping/step.hpp"
#include "core/world/energies.hpp"
#include "core/world/make_world.hpp"
#include "core/world/world.hpp"

using namespace breccia;

namespace {

constexpr double radius = 0.01, gap = 2 * radius;

/// Five spheres in a row, their ends held: four bonds, and four of padding.
World row_of_spheres(Criterion criterion, bool energies) {
  Specimen specimen;
  for (int k = 0; k < 5; ++k) specimen.spheres.push_back({Gid(k + 1), {0, 0, gap * (k - 2)}, radius});
  Material m;
  m.density = 2500;
  m.young_modulus = 28e9;
  m.poisson_ratio = 0.2;
  m.friction_static = 0.9;
  m.friction_dynamic = 0.25;
  m.tensile_strength = 5e6;
  m.shear_strength = 16e6;
  m.limit_compressive_stress = {20e6, 45e6, 70e6};
  m.stiffness_reduction = {3, 12, 22};
  m.damage_normal = m.damage_shear = 0.2;
  if (energies) m.fracture_energy_normal = 20, m.fracture_energy_shear = 200;
  m.criterion = criterion;
  WorldOptions options;
  options.features.criterion = criterion;
  const Body body{Shape::cylinder, gap, 0, 5 * gap};
  return make_world(assemble(specimen, body, {}, options.features, 1), m, {1.0, 0.4}, options);
}

bool all_finite(const World& w) {
  for (std::size_t k = 0; k < w.particles.size; ++k)
    if (!std::isfinite(norm(w.particles.velocity[k]) + norm(w.particles.spin[k]))) return false;
  return true;
}

}  // namespace

TEST_CASE("padding: no force while bonds of the same batch are damaged, pulled, pressed or broken") {
  for (const Criterion criterion : {Criterion::uncoupled, Criterion::coupled, Criterion::mohr_coulomb})
    for (const bool energies : {false, true}) {
      World w = row_of_spheres(criterion, energies);
      CAPTURE(int(criterion));
      REQUIRE(w.bonds.size == 4);
      REQUIRE(w.bonds.padded == 8);
      const double limit = w.material.tensile_strength / w.material.young_modulus * gap;
      for (const double stretch : {1.1 * limit, -100 * limit, 3 * limit}) {
        const std::size_t last =
            w.bonds.row_hi[w.bonds.size - 1];  // the padding has the ends of the last bond
        w.particles.position[last] = w.particles.reference_position[last] + Vec3{0.3 * limit, 0, stretch};
        advance(w);
        CHECK(all_finite(w));
      }
      CHECK(count_broken(w).tension + count_broken(w).shear > 0);
    }
}
