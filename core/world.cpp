#include "core/world.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "core/law_of_material.hpp"
#include "core/parallel.hpp"
#include "core/time_step.hpp"
#include "kernels/bond_energy.hpp"

namespace breccia {
namespace {

using std::numbers::pi;

void set_masses(ParticleTable& p, double density) {
  for (std::size_t row = 0; row < p.size; ++row)
    p.mass[row] = density * 4.0 / 3.0 * pi * p.radius[row] * p.radius[row] * p.radius[row];
}

void set_bond_constants(World& w) {
  const ParticleTable& p = w.particles;
  BondTable& b = w.bonds;
  for (std::size_t k = 0; k < b.padded; ++k) {
    const Row lo = b.row_lo[k], hi = b.row_hi[k];
    b.area[k] *= w.alpha;
    const double length = strain_length_of(b.rest_length[k], p.radius[lo] + p.radius[hi]);
    b.stiffness[k] = k < b.size ? w.law.young * b.area[k] / length : 0.0;  // none for padding
    if (b.damping.empty()) continue;
    const double reduced_mass = p.mass[lo] * p.mass[hi] / (p.mass[lo] + p.mass[hi]);
    b.damping[k] = 2.0 * w.options.contact_damping * std::sqrt(reduced_mass * b.stiffness[k]);
    if (w.options.paper_form)
      b.damping[k] *= pi * w.alpha * std::min(p.radius[lo], p.radius[hi]) / b.rest_length[k];
  }
}

/// What the scene leaves out and the kernel still computes is never reached.
DempackLaw law_of_scene(const Material& material, double shear_ratio, const Features& asked) {
  constexpr double never = std::numeric_limits<double>::infinity();
  DempackLaw law = law_of(material, shear_ratio);
  if (!asked.plasticity) law.limit_stress.fill(never);
  if (!asked.breakage) law.tensile_strength = law.shear_strength = never;
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
  w.features = built_features(options.features);
  w.law = law_of_scene(material, factor.shear_ratio, options.features);
  w.particles = assembly.particles;
  w.bonds = assembly.bonds;
  w.first_top = assembly.first_top;
  set_masses(w.particles, material.density);
  set_bond_constants(w);
  w.critical_dt = critical_time_step(
      w.particles, w.bonds, w.law.shear_ratio,
      std::max(options.global_damping.translation, options.global_damping.rotation), options.threads);
  w.dt = options.safety * w.critical_dt;
  w.platens = make_platens(assembly, w.particles, options.rough_platens, material.young_modulus);
  w.confinement = make_confinement(assembly);
  w.search = make_contact_search(assembly, options.new_contacts, 0.2 * assembly.mean_radius);
  const bool torques = w.features.rotation;
  w.bond_plan = plan_scatter(options.scatter, options.threads, bond_batch, w.bonds.row_lo, w.bonds.row_hi,
                             std::span(w.bonds.gid_lo).first(w.bonds.size),
                             std::span(w.bonds.gid_hi).first(w.bonds.size), w.particles.size, torques);
  w.bond_pass = bond_pass_for(w.features, options.instruction_set);
  return w;
}

BrokenCount count_broken(const World& w) {
  BrokenCount n;
  for (std::size_t k = 0; k < w.bonds.size; ++k) {
    const BondState state = bond_state(w.bonds, k);
    n.tension += state == BondState::broken_tension;
    n.shear += state == BondState::broken_shear;
  }
  return n;
}

double kinetic_energy(const World& w) {
  std::vector<double> blocks;
  const ParticleTable& p = w.particles;
  return sum_rows<double>(p.size, w.options.threads, blocks, [&](std::size_t row) {
    double twice = p.mass[row] * dot(p.velocity[row], p.velocity[row]);
    if (!p.spin.empty()) twice += sphere_inertia(p.mass[row], p.radius[row]) * dot(p.spin[row], p.spin[row]);
    return 0.5 * twice;
  });
}

double stored_energy(const World& w) {
  std::vector<double> blocks;
  const BondTable& b = w.bonds;
  const bool plastic = !b.plastic_stretch.empty(), breakable = !b.damage_normal.empty();
  double sum = sum_rows<double>(b.size, w.options.threads, blocks, [&](std::size_t k) {
    const double distance = norm(w.particles.position[b.row_hi[k]] - w.particles.position[b.row_lo[k]]);
    const BondConstants<double> bond{b.rest_length[k], b.area[k], b.stiffness[k], 0.0};
    const BondHistory<double> h{{b.shear_x[k], b.shear_y[k], b.shear_z[k]},
                                plastic ? b.plastic_stretch[k] : 0.0,
                                breakable ? b.damage_normal[k] : 0.0,
                                breakable ? b.damage_shear[k] : 0.0};
    return stored_energy(w.law, bond, h, distance, w.features.criterion);
  });
  const ContactTable& c = w.contacts;
  for (std::size_t k = 0; k < c.size; ++k) {
    const double overlap =
        c.free_length[k] - norm(w.particles.position[c.row_hi[k]] - w.particles.position[c.row_lo[k]]);
    if (overlap <= 0.0) continue;
    sum += 0.5 * c.stiffness[k] * overlap * overlap;
    if (w.law.shear_ratio > 0.0)
      sum += 0.5 * dot(c.shear_force[k], c.shear_force[k]) / (w.law.shear_ratio * c.stiffness[k]);
  }
  return sum;
}

}  // namespace breccia
