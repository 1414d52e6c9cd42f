#include "core/stepping/step.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/threads.hpp"
#include "core/boundary/loose_surface.hpp"
#include "core/distributed/distribute.hpp"
#include "core/distributed/gather.hpp"
#include "core/distributed/halo.hpp"
#include "core/stepping/look_at_single.hpp"
#include "core/world/cement.hpp"
#include "core/world/energy_accounting.hpp"
#include "core/world/loop_views.hpp"
#include "core/world/scatter_plans.hpp"
#include "core/world/single_precision.hpp"
#include "core/world/stable_step.hpp"
#include "kernels/loops/contact_pass.hpp"
#include "kernels/loops/rolling_pass.hpp"
#include "kernels/math/rotation.hpp"

namespace breccia {
namespace {

bool rebuild_is_due(World& w) {
  const Lap lap(w.phases, Phase::search);
  return rebuild_is_due(w.neighbour_list, w.particles, w.partition, w.step, w.dt, w.options.threads);
}

void search_if_due(World& w) {
  if (!rebuild_is_due(w)) return;
  finish_halo_exchange(w);
  const Lap lap(w.phases, Phase::search);
  // of several ranks the root lists the contacts and looks at the step, for all of them
  World& whole = gather_to_root(w);
  if (w.partition.ranks.is_root()) {
    const ContactMaterial material{w.contact_young, w.contact_poisson, w.shear_ratio,     w.materials,
                                   w.alpha,         w.space,           contact_columns(w)};
    rebuild_neighbour_list(whole.neighbour_list, whole.contacts, whole.particles, material,
                           whole.options.threads);
    start_contact_sums(whole.ledger, whole.contacts);
    revise_step(whole);
  }
  if (!w.partition.ranks.alone()) return broadcast_contacts(w);
  plan_contacts(w);
}

void confine(World& w) {
  const Lap lap(w.phases, Phase::confinement);
  constexpr std::uint64_t measured_every = 16;  // steps
  if (w.confinement.current && w.step % measured_every == 0)
    measure_surface(w.confinement, w.particles, w.partition, w.platens);
  apply_confinement(w.confinement, w.particles, w.partition);
}

/// The record of cracks looks at the bonds that have just broken.
void sync_broken(World& w) {
  if (w.single.empty()) return;
  for (const BreakNotes& notes : w.cracks.notes)
    for (const BreakEvent& broken : notes.room.first(std::min(notes.count, notes.room.size())))
      history_to_table(w.single, broken.bond, broken.bond + 1, w.bonds);
}

/// Calls pass(first, last) for the bonds of a range: all of them, or of several ranks the runs of
/// whole blocks that reach, or do not reach, into other ranks' parts.
template <class Pass>
void for_blocks(const World& w, int range, bool reaching, const Pass& pass) {
  const std::size_t last = w.bond_plan.first(range + 1);
  std::size_t first = w.bond_plan.first(range);
  if (w.partition.ranks.alone()) return pass(first, last);
  const auto is_wanted = [&](std::size_t bond) {
    return (w.partition.interface_blocks[bond / ForceBuffer::capacity] != 0) == reaching;
  };
  while (first < last) {
    std::size_t end = first;
    while (end < last && is_wanted(end)) end += ForceBuffer::capacity;
    end = std::min(end, last);
    if (first < end) pass(first, end);
    first = std::max(end, first + ForceBuffer::capacity);
  }
}

/// Calls pass(first, last, notes) for all bonds of this rank, range by range.
template <class Pass>
void for_bonds(World& w, bool reaching, const Pass& pass) {
  // copies, which lie behind the blocks of owned bonds, break on the rank that owns them
  const std::size_t owned = ForceBuffer::capacity * force_blocks(w.bonds.size);
  for_ranges(w.bond_plan.ranges, [&](int range) {
    for_blocks(w, range, reaching, [&](std::size_t first, std::size_t last) {
      if (first < owned) pass(first, std::min(last, owned), notes_of(w.cracks, range));
      if (last > owned) pass(std::max(first, owned), last, nullptr);
    });
  });
}

void pass_over_bonds(World& w, bool reaching) {
  const Lap lap(w.phases, Phase::bonds);
  BondTable& b = w.bonds;
  if (!w.single.empty()) return pass_in_single(w, [&](const auto& pass) { for_bonds(w, reaching, pass); });
  const Scatter to = scatter_view(w.bond_plan, b.row_lo, b.row_hi, b.arm_offset, w.particles);
  const BondPassIn in = bond_pass_in(w);
  const BondPassHistory history = bond_pass_history(w);
  for_bonds(w, reaching, [&](std::size_t first, std::size_t last, BreakNotes* notes) {
    w.bond_pass(in, history, first, last, to, notes);
  });
}

RollingScene rolling_scene(const World& w) {
  const ParticleTable& p = w.particles;
  return {w.dt, w.material.rolling_friction, w.shear_ratio.front(), p.position, p.velocity, p.spin, p.radius};
}

/// Moments of cement, and resistance of broken bonds to rolling.
void turn_bonds(World& w) {
  BondTable& b = w.bonds;
  if (b.couple.empty()) return;
  const Lap lap(w.phases, Phase::bonds);
  const RollingPairs pairs{b.row_lo,    b.row_hi,        b.rest_length,  b.plastic_stretch,
                           b.stiffness, b.damage_normal, b.damage_shear, b.couple};
  const Scatter to = couple_view(w.bond_plan, b.row_lo, b.row_hi, w.particles);
  const std::size_t owned =
      ForceBuffer::capacity * force_blocks(b.size);  // copies count where they are owned
  const RollingScene scene = rolling_scene(w);
  const bool cement = std::holds_alternative<ParallelBondLaw>(w.laws.front());
  const bool rolls = w.material.rolling_friction > 0.0;
  for_ranges(w.bond_plan.ranges, [&](int range) {
    const auto book = [&](std::size_t k, double taken) {
      if (w.ledger.enabled && k < owned) w.ledger.bonds[k / ForceBuffer::capacity].friction += taken;
    };
    couple_pass(pairs.couple, w.bond_plan.first(range), w.bond_plan.first(range + 1), to, [&](std::size_t k) {
      if (cement && bond_state(b, k) == BondState::intact)
        return bend(w, k, k < owned ? notes_of(w.cracks, range) : nullptr, k < owned);
      if (cement) drop_moment(w, k, k < owned);
      return rolls && roll(scene, pairs, k, book);
    });
  });
}

void roll_contacts(World& w) {
  ContactTable& c = w.contacts;
  if (c.couple.empty()) return;
  const RollingPairs pairs{c.row_lo, c.row_hi, c.free_length, {}, c.stiffness, {},
                           {},       c.couple, c.hertz_normal};
  const Scatter to = couple_view(w.contact_plan, c.row_lo, c.row_hi, w.particles);
  const RollingScene scene = rolling_scene(w);
  for_ranges(w.contact_plan.ranges, [&](int range) {
    const auto book = [&](std::size_t k, double taken) {
      if (w.ledger.enabled) w.ledger.contacts[k / ForceBuffer::capacity].friction += taken;
    };
    couple_pass(pairs.couple, w.contact_plan.first(range), w.contact_plan.first(range + 1), to,
                [&](std::size_t k) { return roll(scene, pairs, k, book); });
  });
}

void bond_forces(World& w) {
  // a bond whose two ends get new anchors gets them at once
  if (!w.single.moved_far.empty()) finish_halo_exchange(w);
  renew_far(w);
  pass_over_bonds(w, false);
  if (!w.partition.ranks.alone()) {
    finish_halo_exchange(w);
    renew_far(w);
    pass_over_bonds(w, true);
  }
  turn_bonds(w);
  const Lap lap(w.phases, Phase::bonds);
  sync_broken(w);
  record_cracks(w.cracks, w.laws, w.features.criterion == Criterion::coupled, w.time, w.dt, w.particles,
                w.bonds);
}

void contact_forces(World& w) {
  if (w.contacts.padded == 0) return;
  const Lap lap(w.phases, Phase::contacts);
  ParticleTable& p = w.particles;
  ContactTable& c = w.contacts;
  const Scatter to = scatter_view(w.contact_plan, c.row_lo, c.row_hi, c.arm_offset, p);
  const ContactPassIn in{w.dt,       w.shear_ratio, w.friction,     w.features.rotation,
                         p.position, p.velocity,    p.spin,         p.radius,
                         c.row_lo,   c.row_hi,      c.arm_offset,   c.stiffness,
                         c.damping,  c.law,         c.hertz_normal, c.hertz_tangential};
  const ContactPassHistory history{c.free_length, c.shear_force, c.viscous_force, w.ledger.contacts};
  for_ranges(w.contact_plan.ranges, [&](int range) {
    contact_pass(in, history, w.contact_plan.first(range), w.contact_plan.first(range + 1), to);
  });
  roll_contacts(w);
  collect(w.contact_plan, p, w.partition.owned(), w.options.threads);
}

void gather_bond_forces(World& w) {
  const Lap lap(w.phases, Phase::gather);
  if (!w.single.empty()) return collect_single(w);
  collect(w.bond_plan, w.particles, w.partition.owned(), w.options.threads);
}

void restrain_laterally(World& w) {
  const Lap lap(w.phases, Phase::confinement);
  restrain_laterally(w.confinement, w.particles, w.partition);
}

void hold_ends(World& w) {
  const Lap lap(w.phases, Phase::platens);
  push_back(w.end_walls, w.platens, w.particles, w.partition, w.step, w.dt, w.options.threads);
}

void cut(World& w) {
  const Lap lap(w.phases, Phase::platens);
  press_tool(w.tool, w.particles, w.partition, w.step, w.dt);
}

void let_loose_drift(World& w) {
  const Lap lap(w.phases, Phase::confinement);
  const double impedance = std::sqrt(w.material.young_modulus * w.material.density);
  let_loose_drift(w.confinement, w.particles, w.partition, {impedance, w.platens.rough, w.dt, w.step});
}

OuterWorks account_outside(World& w) {
  if (!w.ledger.enabled) return {};
  const Lap lap(w.phases, Phase::ledger);
  collect_rows(w, w.end_walls.rows);
  collect_rows(w, w.tool.rows);
  return works_from_outside(w);
}

void move_platens(World& w) {
  const Lap lap(w.phases, Phase::platens);
  drive_platens(w.platens, w.particles, w.partition, w.first_top, w.end_walls.push, w.dt);
}

void integrate(World& w, const OuterWorks& outer) {
  const Lap lap(w.phases, Phase::integrate);
  const ParticleTable& p = w.particles;
  const Motion motion = motion_of(w);
  const GlobalDamping& damping = w.options.global_damping;
  const Rows lower = w.partition.owned(p.free, w.first_top), upper = w.partition.owned(w.first_top, p.size);
  const StepWork work = move_free(w);
  integrate_held(motion, lower.first, lower.last, w.dt, damping, {w.platens.velocity[0], !w.platens.rough});
  integrate_held(motion, upper.first, upper.last, w.dt, damping, {w.platens.velocity[1], !w.platens.rough});
  record_motion(w, work.events);
  w.watch.reading = work.gauge - w.watch.reference;
  if (w.ledger.enabled) enter_step(w, work, outer);
}

/// How particles have turned, where somebody wants to know.
void turn(World& w) {
  ParticleTable& p = w.particles;
  if (p.orientation.empty()) return;
  const Lap lap(w.phases, Phase::integrate);
  const Rows mine = w.partition.owned();
  for_rows(mine.last - mine.first, w.options.threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t row = mine.first + first; row < mine.first + last; ++row)
      p.orientation[row] = followed_by(p.orientation[row], w.dt * p.spin[row]);
  });
}

}  // namespace

void advance(World& w) {
  look_at_single(w);
  search_if_due(w);
  confine(w);
  bond_forces(w);
  gather_bond_forces(w);
  contact_forces(w);
  hold_ends(w);
  cut(w);
  restrain_laterally(w);
  move_platens(w);
  let_loose_drift(w);
  integrate(w, account_outside(w));
  turn(w);
  start_halo_exchange(w);
  w.time += w.dt;
  ++w.step;
}

}  // namespace breccia
