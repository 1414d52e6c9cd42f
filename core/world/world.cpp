#include "core/world/world.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/threads.hpp"
#include "core/bonding/law_of_material.hpp"
#include "core/elastic/elastic_network.hpp"
#include "kernels/loops/bond_energy.hpp"

namespace breccia {
namespace {

using std::numbers::pi;

void set_masses(ParticleTable& p, double density, Space space) {
  for (std::size_t row = 0; row < p.size; ++row) {
    const double r = p.radius[row];
    // (B1)
    p.mass[row] = density * (space == Space::two_d ? pi * r * r : 4.0 / 3.0 * pi * r * r * r);
  }
}

void set_bond_constants(World& w) {
  const ParticleTable& p = w.particles;
  BondTable& b = w.bonds;
  // a strength area of its own partitions space as it is; otherwise strength and stiffness share alpha A
  for (double& area : b.area) area *= w.alpha;  // (P21) (B11)
  const std::vector<double> stiffness = bond_stiffness(w.law, p, b);
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

}  // namespace

World make_world(const Assembly& assembly, const Material& material, const AreaFactor& factor,
                 const WorldOptions& options) {
  World w;
  w.options = options;
  w.body = assembly.body;
  w.material = material;
  w.alpha = factor.alpha;
  w.space = assembly.space;
  w.volume = assembly.volume();
  w.law = law_of_scene(material, factor.shear_ratio, options.features);
  const LoopKind kind{options.precision, options.ledger};
  w.features = built_features(w.law, options.features, kind);
  std::visit(
      [&](const auto& law) {
        w.young = law.young;
        w.shear_ratio = law.shear_ratio;
        w.friction = law.failure.friction_dynamic;
      },
      w.law);
  w.particles = assembly.particles;
  w.bonds = assembly.bonds;
  w.first_top = assembly.first_top;
  w.partition = serial_partition(w.particles.size);
  set_masses(w.particles, material.density, w.space);
  set_bond_constants(w);
  choose_step(w);
  if (options.precision == Precision::mixed) w.single_bonds = single_bonds(w.bonds);
  w.platens = make_platens(assembly, w.particles, options.rough_platens, material.young_modulus);
  w.confinement = make_confinement(assembly, options.skin_weights, options.rigid_skin);
  // (B97)
  w.neighbour_list = make_neighbour_list(assembly, options.new_contacts, 0.2 * assembly.mean_radius);
  w.cracks = make_crack_record(options.cracks && w.features.breakage, options.threads, w.bonds.size);
  w.bond_plan =
      plan_scatter(options.scatter, options.threads, ForceBuffer::capacity, w.bonds.row_lo, w.bonds.row_hi,
                   std::span(w.bonds.gid_lo).first(w.bonds.size),
                   std::span(w.bonds.gid_hi).first(w.bonds.size), w.bonds.arm_offset, w.particles.size);
  w.bond_pass = bond_pass_for(w.law, w.features, options.instruction_set, kind);
  w.integrate_free = integrate_free_for(options.instruction_set);
  w.work_of_free = work_of_free_for(options.instruction_set);
  w.undamaged_energy = undamaged_energy_for(options.instruction_set);
  if (options.ledger) {
    for (Column<double>* column : {&w.bonds.spring_force, &w.bonds.viscous_force, &w.bonds.shear_factor})
      column->assign(w.bonds.padded, 0.0);
    w.ledger = make_ledger(w);
  }
  return w;
}

BondPassIn bond_pass_in(const World& w) {
  const ParticleTable& p = w.particles;
  const BondTable& b = w.bonds;
  return {w.dt,
          constants_of(w.law),
          p.position,
          p.velocity,
          p.spin,
          b.row_lo,
          b.row_hi,
          b.rest_length,
          constant_columns(b),
          w.single_bonds.constants()};
}

BondEnergyIn bond_energy_in(const World& w, double back) {
  const ParticleTable& p = w.particles;
  const BondTable& b = w.bonds;
  return {.position = p.position,
          .velocity = p.velocity,
          .row_lo = b.row_lo,
          .row_hi = b.row_hi,
          .rest_length = b.rest_length,
          .stiffness = b.stiffness,
          .shear_x = b.shear_x,
          .shear_y = b.shear_y,
          .shear_z = b.shear_z,
          .plastic_stretch = b.plastic_stretch,
          .damage_normal = b.damage_normal,
          .damage_shear = b.damage_shear,
          .back = back,
          .shear_ratio = w.shear_ratio};
}

Motion motion_of(World& w) {
  ParticleTable& p = w.particles;
  return {p.position, p.velocity,        p.spin,
          p.force,    p.torque,          p.mass,
          p.radius,   inertia_factor(w), w.options.features.rotation};
}

BondPassHistory bond_pass_history(World& w) {
  BondTable& b = w.bonds;
  return {history_columns(b),
          w.single_bonds.history(),
          {b.spring_force, b.viscous_force, b.shear_factor, w.ledger.bonds}};
}

void sync(World& w) { history_to_double(w.single_bonds, 0, w.bonds.padded, w.bonds); }

void plan_contacts(World& w) {
  const ContactTable& c = w.contacts;
  w.contact_plan = plan_scatter(w.options.scatter, w.options.threads, ForceBuffer::capacity, c.row_lo, c.row_hi,
                                c.gid_lo, c.gid_hi, c.arm_offset, w.particles.size);
}

double inertia_factor(const World& w) {
  return w.space == Space::two_d ? disc_inertia_factor : sphere_inertia_factor;
}

BrokenCount count_broken(const World& w) {
  std::vector<BrokenCount> blocks;
  return sum_pairs(w.partition, w.bonds, w.options.threads, blocks, [&](std::size_t k) {
    const BondState state = bond_state(w.bonds, k);
    return BrokenCount{std::size_t{state == BondState::broken_tension},
                       std::size_t{state == BondState::broken_shear}};
  });
}

namespace {

/// J, of one particle.
double kinetic_energy_of(const ParticleTable& p, std::size_t row, double factor) {
  double twice = p.mass[row] * dot(p.velocity[row], p.velocity[row]);
  if (!p.spin.empty()) twice += inertia(factor, p.mass[row], p.radius[row]) * dot(p.spin[row], p.spin[row]);
  return 0.5 * twice;
}

}  // namespace

double kinetic_energy(const World& w) {
  std::vector<double> blocks;
  const double factor = inertia_factor(w);
  return sum_particles(w.partition, w.options.threads, blocks,
                       [&](std::size_t row) { return kinetic_energy_of(w.particles, row, factor); });
}

double kinetic_energy_of_bonded(const World& w) {
  std::vector<char> is_held(w.particles.position.size(), 0);
  for (std::size_t k = 0; k < w.bonds.padded; ++k)
    if (w.bonds.stiffness[k] > 0.0 && bond_state(w.bonds, k) == BondState::intact)
      is_held[w.bonds.row_lo[k]] = is_held[w.bonds.row_hi[k]] = 1;
  std::vector<double> blocks;
  const double factor = inertia_factor(w);
  return sum_particles(w.partition, w.options.threads, blocks, [&](std::size_t row) {
    return is_held[row] ? kinetic_energy_of(w.particles, row, factor) : 0.0;
  });
}

double stored_energy(const World& w, double back) {
  std::vector<double> blocks;
  const ParticleTable& p = w.particles;
  const auto distance_of = [&](Row lo, Row hi) {
    return norm(p.position[hi] - p.position[lo] - back * (p.velocity[hi] - p.velocity[lo]));
  };
  const BondTable& b = w.bonds;
  const bool coupled = w.features.criterion == Criterion::coupled;
  const BondEnergyIn in = bond_energy_in(w, back);
  const double sum = std::visit(
      [&](const auto& law) {
        return sum_pair_ranges(
            w.partition, b, w.options.threads, blocks, [&](std::size_t first, std::size_t last) {
              double energy = w.undamaged_energy(in, first, last);
              if (b.damage_normal.empty()) return energy;
              for (std::size_t k = first; k < last; ++k)
                if (b.damage_normal[k] > 0.0 || b.damage_shear[k] > 0.0)
                  energy += stored_energy(law, constants_of_bond(b, k), history_of_bond(b, k),
                                          distance_of(b.row_lo[k], b.row_hi[k]), coupled);
              return energy;
            });
      },
      w.law);
  const ContactTable& c = w.contacts;
  if (!w.neighbour_list.awake) return sum;
  return sum + sum_pairs(w.partition, c, w.options.threads, blocks, [&](std::size_t k) {
           const double overlap = c.free_length[k] - distance_of(c.row_lo[k], c.row_hi[k]);
           if (overlap <= 0.0) return 0.0;
           double energy = 0.5 * c.stiffness[k] * overlap * overlap;
           if (w.shear_ratio > 0.0)
             energy += 0.5 * dot(c.shear_force[k], c.shear_force[k]) / (w.shear_ratio * c.stiffness[k]);
           return energy;
         });
}

}  // namespace breccia
