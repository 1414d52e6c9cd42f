#include "core/world/loop_views.hpp"

#include "kernels/loops/bond_energy.hpp"

namespace breccia {

BondPassIn bond_pass_in(const World& w) {
  const ParticleTable& p = w.particles;
  const BondTable& b = w.bonds;
  return {w.dt,     w.laws,   p.position,    p.velocity,          p.spin,
          b.row_lo, b.row_hi, b.rest_length, constant_columns(b), b.law};
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
          .shear_ratio = w.shear_ratio.front()};
}

SingleEnergyIn single_energy_in(const World& w, double back) {
  const SingleStore& s = w.single;
  return {.bonds = s.bonds,
          .rare = s.rare,
          .motion = s.motion,
          .length = s.quanta.length,
          .moved = s.quanta.motion,
          .force = s.quanta.force,
          .shear_ratio = w.shear_ratio.front(),
          .before_last_move = back != 0.0};
}

Motion motion_of(World& w) {
  ParticleTable& p = w.particles;
  return {p.position,     p.velocity,        p.spin,
          p.force,        p.torque,          p.mass,
          p.radius,       inertia_factor(w), w.options.features.rotation,
          w.watch.weights};
}

BondPassHistory bond_pass_history(World& w) {
  BondTable& b = w.bonds;
  return {history_columns(b), {b.spring_force, b.viscous_force, b.shear_factor, w.ledger.bonds}};
}

SinglePassIn single_pass_in(World& w) {
  SingleStore& s = w.single;
  const BondTable& b = w.bonds;
  return {.laws = s.laws,
          .law = b.law,
          .bonds = s.bonds,
          .rare = s.rare,
          .ledger = s.ledger,
          .damaged = s.damaged,
          .losses = w.ledger.bonds,
          .motion = s.motion,
          .sums = s.sums,
          .targets = {s.near, s.far, w.bond_plan.kind == ScatterKind::atomic && !s.near.empty()},
          .row_lo = b.row_lo,
          .row_hi = b.row_hi,
          .length = s.quanta.length,
          .moved = s.quanta.motion,
          .force = s.quanta.force,
          .force_limit = static_cast<float>(s.quanta.force_limit),
          .own_strength_area = s.own_strength_area};
}

RecordedMotion recorded_motion(World& w) {
  const ParticleTable& p = w.particles;
  return {.position = p.position,
          .velocity = p.velocity,
          .spin = p.spin,
          .radius = p.radius,
          .records = w.single.motion,
          .origin = w.single.quanta.origin,
          .length = w.single.quanta.length,
          .moved = w.single.quanta.motion};
}

CollectedSums collected_sums(World& w) {
  ParticleTable& p = w.particles;
  return {w.single.sums, p.force, p.torque, p.radius, w.single.quanta.force};
}

double inertia_factor(const World& w) {
  return w.space == Space::two_d ? disc_inertia_factor : sphere_inertia_factor;
}

ContactColumns contact_columns(const World& w) {
  return {w.features, w.ledger.enabled, w.material.rolling_friction > 0.0,
          w.material.contact_law == ContactLaw::hertz_mindlin};
}

}  // namespace breccia
