#include "core/world/make_world.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/bonding/law_of_material.hpp"
#include "core/elastic/elastic_network.hpp"
#include "core/world/scatter_plans.hpp"
#include "core/world/single_precision.hpp"
#include "core/world/stable_step.hpp"

namespace breccia {
namespace {

using std::numbers::pi;

void set_masses(ParticleTable& p, std::span<const BondMaterial> materials, Space space) {
  for (std::size_t row = 0; row < p.size; ++row) {
    const double r = p.radius[row];
    const std::size_t of = p.material.empty() ? 0 : p.material[row];
    // (B1)
    p.mass[row] =
        materials[of].material.density * (space == Space::two_d ? pi * r * r : 4.0 / 3.0 * pi * r * r * r);
  }
}

void set_bond_constants(World& w) {
  const ParticleTable& p = w.particles;
  BondTable& b = w.bonds;
  // a strength area of its own partitions space as it is; otherwise strength and stiffness share
  // alpha A
  for (double& area : b.area) area *= w.alpha;  // (P21) (B11)
  const std::vector<double> stiffness = bond_stiffness(w.laws, p, b);
  for (std::size_t k = 0; k < b.padded; ++k) {
    const Row lo = b.row_lo[k], hi = b.row_hi[k];
    b.stiffness[k] = k < b.size ? stiffness[k] : 0.0;  // none for padding
    if (!b.arm_offset.empty())
      b.arm_offset[k] = 0.5 * (p.radius[lo] - p.radius[hi]) / (p.radius[lo] + p.radius[hi]);
  }
}

/// What the scene leaves out and the kernel still computes is never reached.
BondLaw law_of_scene(const Material& material, double shear_ratio, const Features& asked) {
  constexpr double never = std::numeric_limits<double>::infinity();
  Material m = material;
  if (!asked.breakage) {
    m.tensile_strength = m.shear_strength = never;
    for (const char* strength : {"normal_strength", "bond_shear_strength"})
      if (m.own.contains(strength)) m.own[strength] = never;
  }
  BondLaw law = law_of(m, shear_ratio);
  if (!asked.plasticity) std::visit([](auto& l) { l.never_yield(); }, law);
  return law;
}

/// The law of each pair of materials.
void set_laws(World& w, std::span<const BondMaterial> materials) {
  w.materials = materials.size();
  for_each_pair(materials.size(), [&](std::size_t one, std::size_t other) {
    const BondMaterial m = one == other ? materials[one] : between(materials[one], materials[other]);
    w.laws.push_back(law_of_scene(m.material, m.shear_ratio, w.options.features));
    w.contact_young.push_back(m.material.young_modulus);
    w.contact_poisson.push_back(m.material.poisson_ratio);
  });
  for (const BondLaw& law : w.laws) {
    w.shear_ratio.push_back(shear_ratio_of(law));
    w.friction.push_back(friction_of(law));
  }
  w.young = std::visit([](const auto& law) { return law.young; }, w.laws.front());
}

/// What the scene asks of the loop, given its laws.
Features asked_of_loop(const World& w) {
  Features asked = w.options.features;
  const auto elsewhere = [](const BondLaw& law) {
    return std::visit([](const auto& l) { return unloads_elsewhere(l); }, law);
  };
  asked.several = w.materials > 1;
  asked.unloading = asked.plasticity && std::any_of(w.laws.begin(), w.laws.end(), elsewhere);
  return asked;
}

}  // namespace

World make_world(const Assembly& assembly, const Material& material, const AreaFactor& factor,
                 const WorldOptions& asked, std::span<const BondMaterial> others) {
  World w;
  WorldOptions options = asked;
  if (options.precision == Precision::single && bond_too_short_for_single(assembly.bonds))
    options.precision = Precision::full;
  w.options = options;
  w.body = assembly.body;
  w.material = material;
  w.alpha = factor.alpha;
  w.space = assembly.space;
  w.volume = assembly.volume();
  std::vector<BondMaterial> materials{{material, factor.shear_ratio}};
  materials.insert(materials.end(), others.begin(), others.end());
  set_laws(w, materials);
  const LoopKind kind{options.precision, options.ledger};
  w.features = built_features(w.laws.front(), asked_of_loop(w), kind);
  w.particles = assembly.particles;
  w.bonds = assembly.bonds;
  w.first_top = assembly.first_top;
  w.partition = serial_partition(w.particles.size);
  set_masses(w.particles, materials, w.space);
  set_bond_constants(w);
  choose_step(w);
  w.platens = make_platens(assembly, w.particles, options.rough_platens, material.young_modulus);
  w.end_walls = make_end_walls(assembly, w.young, w.alpha);
  w.tool = make_tool(options.cutting, assembly, w.young, w.alpha);
  w.confinement = make_confinement(assembly, options.skin_weights, options.rigid_sides);
  // (B97)
  w.neighbour_list = make_neighbour_list(assembly, options.new_contacts, 0.2 * assembly.mean_radius);
  w.neighbour_list.every = options.search_every;
  w.cracks = make_crack_record(options.cracks && w.features.breakage, options.threads, w.bonds.size);
  plan_bonds(w);
  if (options.precision == Precision::single)
    w.single_pass = single_pass_for(w.laws.front(), w.features, options.instruction_set);
  else
    w.bond_pass = bond_pass_for(w.laws.front(), w.features, options.instruction_set, kind);
  w.integrate_single = integrate_single_for(options.instruction_set);
  w.refresh_records = refresh_records_for(options.instruction_set);
  w.single_energy = single_energy_for(options.instruction_set);
  w.collect_sums = collect_sums_for(options.instruction_set);
  w.integrate_free = integrate_free_for(options.instruction_set);
  w.undamaged_energy = undamaged_energy_for(options.instruction_set);
  w.confinement.current = options.current_surface;
  w.confinement.impedance = std::sqrt(material.young_modulus * material.density);
  const bool cement = std::holds_alternative<ParallelBondLaw>(w.laws.front()) && w.features.rotation;
  if (material.rolling_friction > 0.0 || cement) w.bonds.couple.assign(w.bonds.padded, {});
  if (options.orientation) w.particles.orientation.assign(w.particles.padded, {});
  if (options.ledger) {
    for (Column<double>* column : {&w.bonds.spring_force, &w.bonds.viscous_force, &w.bonds.shear_factor})
      column->assign(w.bonds.padded, 0.0);
    w.ledger = make_ledger(w.bonds.padded);
  }
  start_single(w);
  return w;
}

}  // namespace breccia
