// Several materials in one bonded scene: means between two of them, and each bond under a law of
// its own in the loop over bonds.
#include <doctest/doctest.h>

#include <random>

#include "core/bonding/several_materials.hpp"
#include "core/tables/state_hash.hpp"
#include "core/world/energy_accounting.hpp"
#include "tests/scene.hpp"

using namespace breccia;
namespace ref = breccia::reference;

namespace {

/// Three materials that differ in everything that a bond takes from one.
std::vector<BondMaterial> three_materials() {
  std::vector<BondMaterial> all;
  for (const double k : {1.0, 1.7, 0.6}) {
    ref::Parameters p;
    p.E *= k, p.nu = 0.1 * k, p.sigma_t *= 0.7 * k, p.tau_f *= 1.2 / k, p.density *= k;
    p.mu1 *= k, p.mu2 *= 0.5 * k, p.delta_n = 0.3 * k, p.delta_s = 0.4 * k;
    for (double& limit : p.LCS) limit *= 0.8 * k;
    for (double& reduction : p.YRC) reduction *= k;
    all.push_back({scene::material_of(p), paper_shear_ratio(p.nu)});
  }
  return all;
}

/// Spheres of groups 1, 2 and 3: layers where `mixed` is false.
Specimen three_groups(std::size_t spheres, bool mixed) {
  Specimen s = scene::small_packing(spheres);
  std::mt19937_64 random(3);
  for (SpecimenSphere& sphere : s.spheres)
    sphere.group = mixed                     ? 1 + static_cast<int>(random() % 3)
                   : sphere.centre.z < -0.02 ? 1
                   : sphere.centre.z < 0.02  ? 2
                                             : 3;
  return s;
}

Assembly assembly_of(const Specimen& s, const Features& features) {
  BondingRule rule;
  rule.materials = {2, 3};
  rule.across = true;
  return assemble(s, scene::small_cylinder(), rule, features, 1);
}

World world_of(const Specimen& s, const std::vector<BondMaterial>& m, const WorldOptions& o) {
  Features features = o.features;
  features.several = true;
  features = built_features(law_of(m[0].material, m[0].shear_ratio), features, {Precision::full, o.ledger});
  AreaFactor f;
  f.alpha = 0.8, f.shear_ratio = m[0].shear_ratio;
  World w = make_world(assembly_of(s, features), m[0].material, f, o, std::span(m).subspan(1));
  scene::drive(w, 3, -3);
  return w;
}

double harmonic(double a, double b) { return 2 / (1 / a + 1 / b); }

}  // namespace

TEST_CASE("several materials: pairs are numbered in their order, whichever comes first") {
  for (std::size_t n = 1; n <= most_materials; ++n) {
    std::size_t number = 0;
    for_each_pair(n, [&](std::size_t a, std::size_t b) {
      CHECK(law_between(LawIndex(a), LawIndex(b), n) == number);
      CHECK(law_between(LawIndex(b), LawIndex(a), n) == number);
      ++number;
    });
    CHECK(number <= 256);
  }
}

TEST_CASE("several materials: E and nu are harmonic means, strengths arithmetic [1e-14]") {
  const std::vector<BondMaterial> all = three_materials();
  const Material &a = all[0].material, &b = all[1].material;
  const BondMaterial m = between(all[0], all[1]), other = between(all[1], all[0]);
  const auto near = [](double x) { return doctest::Approx(x).epsilon(1e-14); };
  const double nu = harmonic(a.poisson_ratio, b.poisson_ratio);
  CHECK(m.material.young_modulus == near(harmonic(a.young_modulus, b.young_modulus)));
  CHECK(m.material.poisson_ratio == near(nu));
  CHECK(m.shear_ratio == near(paper_shear_ratio(nu)));
  CHECK(other.shear_ratio == near(m.shear_ratio));
  CHECK(m.material.tensile_strength == near((a.tensile_strength + b.tensile_strength) / 2));
  CHECK(m.material.shear_strength == near((a.shear_strength + b.shear_strength) / 2));
  CHECK(m.material.friction_dynamic == near((a.friction_dynamic + b.friction_dynamic) / 2));
  CHECK(m.material.limit_compressive_stress[2] ==
        near((a.limit_compressive_stress[2] + b.limit_compressive_stress[2]) / 2));
  const auto matched = [](const Material& of) {
    return BondMaterial{of, matched_shear_ratio(of.poisson_ratio)};
  };
  CHECK(between(matched(a), matched(b)).shear_ratio == near(matched_shear_ratio(nu)));
  CHECK(between(all[0], all[0]).shear_ratio == near(all[0].shear_ratio));
  CHECK(between(all[0], all[0]).material.young_modulus == near(a.young_modulus));
}

TEST_CASE("several materials: a fracture energy and a damage have no mean") {
  Material a = three_materials()[0].material, b = a;
  CHECK(unmatched(a, b).empty());
  b.fracture_energy_normal = 50;
  CHECK(unmatched(a, b) == "fracture_energy_normal");
  a.fracture_energy_normal = 20;
  CHECK(unmatched(a, b).empty());
}

TEST_CASE("several materials: spheres have the density of theirs, bonds the stiffness of the pair [1e-12]") {
  const std::vector<BondMaterial> m = three_materials();
  const Specimen s = three_groups(300, true);
  const World w = world_of(s, m, scene::options({}));
  const ParticleTable& p = w.particles;
  for (std::size_t row = 0; row < p.size; ++row) {
    const double r = p.radius[row], ball = 4.0 / 3.0 * std::numbers::pi * r * r * r;
    CHECK(p.mass[row] == doctest::Approx(m[p.material[row]].material.density * ball).epsilon(1e-12));
  }
  const BondTable& b = w.bonds;
  std::size_t across = 0;
  for (std::size_t k = 0; k < b.size; ++k) {
    const LawIndex i = p.material[b.row_lo[k]], j = p.material[b.row_hi[k]];
    across += i != j;
    const double young = harmonic(m[i].material.young_modulus, m[j].material.young_modulus);
    CHECK(b.stiffness[k] == doctest::Approx(young * b.area[k] / b.rest_length[k]).epsilon(1e-12));
  }
  CHECK(across > b.size / 3);
}

TEST_CASE("several materials: every lane moves under its own law alone [every register, 1e-12]") {
  const std::vector<BondMaterial> m = three_materials();
  for (const bool ledger : {false, true})
    for (const InstructionSet set : scene::sets_of_this_machine()) {
      WorldOptions o = scene::options({});
      o.ledger = ledger, o.instruction_set = set, o.scatter = ScatterKind::gather;
      World w = world_of(three_groups(300, true), m, o);
      for (int k = 0; k < 400; ++k) advance(w);
      BondTable& b = w.bonds;
      std::size_t damaged = 0, yielded = 0;
      for (std::size_t k = 0; k < b.size; ++k)
        damaged += b.damage_normal[k] > 0 || b.damage_shear[k] > 0, yielded += b.plastic_stretch[k] < 0;
      CHECK(damaged > b.size / 50);
      CHECK(yielded > b.size / 50);
      // one more pass, by the loop of several laws, and by that of one law, for each of them
      const auto after = [&](const BondPass pass, std::span<const BondLaw> laws) {
        World next = w;
        BondPassIn in = bond_pass_in(next);
        in.laws = laws;
        std::vector<BondLoad> loads(next.bonds.padded);
        Scatter to;
        to.mode = ScatterMode::column, to.bond_load = loads;
        pass(in, bond_pass_history(next), 0, next.bonds.padded, to, nullptr);
        return std::pair(std::move(next.bonds), std::move(loads));
      };
      const auto [mixed, mixed_loads] = after(w.bond_pass, w.laws);
      Features alone = w.features;
      alone.several = false;
      for (std::size_t law = 0; law < w.laws.size(); ++law) {
        const auto [single, loads] = after(bond_pass_for(w.laws[law], alone, set, {Precision::full, ledger}),
                                           std::span(w.laws).subspan(law, 1));
        for (std::size_t k = 0; k < b.size; ++k) {
          if (b.law[k] != law) continue;
          const double scale = 1e6 * b.area[k];
          CHECK(norm(loads[k].force - mixed_loads[k].force) <= 1e-12 * scale);
          CHECK(std::abs(single.shear_x[k] - mixed.shear_x[k]) <= 1e-12 * scale);
          CHECK(single.plastic_stretch[k] == doctest::Approx(mixed.plastic_stretch[k]).epsilon(1e-12));
          CHECK(single.damage_normal[k] == doctest::Approx(mixed.damage_normal[k]).epsilon(1e-9));
          CHECK(single.damage_shear[k] == doctest::Approx(mixed.damage_shear[k]).epsilon(1e-9));
          if (ledger) CHECK(std::abs(single.viscous_force[k] - mixed.viscous_force[k]) <= 1e-12 * scale);
        }
      }
    }
}

TEST_CASE("several materials: three that are the same break as one does [rel 1e-9]") {
  const std::vector<BondMaterial> same(3, three_materials()[0]);
  WorldOptions o = scene::options({});
  World w = world_of(three_groups(300, true), same, o);
  Specimen plain = three_groups(300, true);
  for (SpecimenSphere& s : plain.spheres) s.group = 1;
  AreaFactor f;
  f.alpha = 0.8, f.shear_ratio = same[0].shear_ratio;
  World one = make_world(assemble(plain, scene::small_cylinder(), {}, o.features, 1), same[0].material, f, o);
  one.platens.velocity = w.platens.velocity;
  CHECK(w.critical_dt == doctest::Approx(one.critical_dt).epsilon(1e-9));
  one.dt = w.dt;
  for (int k = 0; k < 150; ++k) advance(w), advance(one);
  for (std::size_t row = 0; row < w.particles.size; ++row)
    CHECK(norm(w.particles.position[row] - one.particles.position[row]) <= 1e-9 * one.particles.radius[row]);
}

TEST_CASE("several materials: a cylinder of three layers keeps its books while it breaks, 1e-4") {
  WorldOptions o = scene::options({});
  o.ledger = true;
  for (const int threads : {1, 2}) {
    o.threads = threads;
    World w = world_of(three_groups(500, false), three_materials(), o);
    for (int k = 0; k < 1500; ++k) advance(w);
    const EnergyBalance e = energy_balance(w);
    std::size_t broken = 0;
    for (std::size_t k = 0; k < w.bonds.size; ++k) broken += bond_state(w.bonds, k) != BondState::intact;
    CHECK(broken > 50);
    CHECK(std::abs(e.imbalance()) < 1e-4 * e.work);
  }
}

TEST_CASE("several materials: the soft layer takes the strain, as springs in a row do, 8 %") {
  // E of the layers 28, 28 x 1.7 and 28 x 0.6 GPa: strains are as their inverses
  std::vector<BondMaterial> m = three_materials();
  for (BondMaterial& one : m) one.material.poisson_ratio = 0.2, one.shear_ratio = paper_shear_ratio(0.2);
  WorldOptions o = scene::options({});
  o.features.breakage = o.features.plasticity = false;
  o.global_damping = {0.3, 0.3};
  World w = world_of(three_groups(2000, false), m, o);
  scene::drive(w, 0.02, -0.02);
  for (int k = 0; k < 3000; ++k) advance(w);
  const auto strain = [&](double from, double to) {  // slope of u_z over z
    double n = 0, z = 0, u = 0, zz = 0, zu = 0;
    for (std::size_t row = 0; row < w.particles.size; ++row) {
      const double at = w.particles.reference_position[row].z, by = w.particles.position[row].z - at;
      if (at < from || at > to) continue;
      n += 1, z += at, u += by, zz += at * at, zu += at * by;
    }
    return (n * zu - z * u) / (n * zz - z * z);
  };
  const double low = strain(-0.042, -0.024), middle = strain(-0.016, 0.016), high = strain(0.024, 0.042);
  CHECK(middle / low == doctest::Approx(1 / 1.7).epsilon(0.08));
  CHECK(high / low == doctest::Approx(1 / 0.6).epsilon(0.08));
}
