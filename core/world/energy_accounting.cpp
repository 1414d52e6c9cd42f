#include "core/world/energy_accounting.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/threads.hpp"
#include "core/world/energies.hpp"
#include "core/world/loop_views.hpp"
#include "kernels/loops/bond_energy.hpp"

namespace breccia {
namespace {

/// What global damping does to a velocity (or a spin) that a force (or a torque) kicks.
struct Braked {
  double brake = 0;  ///< force of the brake over the velocity, which it opposes
  Vec3 after;        ///< velocity half a step after the force
};

/// @param part     of the global damping
/// @param inertia  kg, kg m^2
Braked braked(const World& w, const Vec3& force, const Vec3& velocity, double part, double inertia) {
  const double brake = brake_on(velocity, force, part, w.options.global_damping.viscous, inertia);
  return {brake, velocity + (w.dt / inertia) * (force - brake * velocity)};
}

Braked braked_motion(const World& w, std::size_t row) {
  const ParticleTable& p = w.particles;
  Vec3 force = p.force[row], velocity = p.velocity[row];
  const bool held = row >= p.free;
  if (held) force.z = velocity.z = 0.0;  // a smooth platen leaves two directions free
  Braked b = braked(w, force, velocity, w.options.global_damping.translation, p.mass[row]);
  if (!held) return b;
  const Vec3& platen = w.platens.velocity[row >= w.first_top];
  if (w.platens.rough) return {0.0, platen};
  b.after.z = platen.z;
  return b;
}

/// What the platen does to a row that it holds: it prescribes z, and x and y where it is rough.
/// (B49)
void add_platen(const World& w, std::size_t row, const Vec3& after, StepWork& s) {
  const ParticleTable& p = w.particles;
  const Vec3& v = p.velocity[row];
  Vec3 reaction = (p.mass[row] / w.dt) * (after - v) - p.force[row];
  if (!w.platens.rough) reaction.x = reaction.y = 0.0;
  s.held_this = 0.5 * w.dt * dot(reaction, v);
  s.held_next = 0.5 * w.dt * dot(reaction, after);
}

/// On a row that a platen holds.
StepWork work_on_held(const World& w, std::size_t row) {
  const ParticleTable& p = w.particles;
  const double half = 0.5 * w.dt, m = p.mass[row];
  StepWork s;
  Vec3 v = p.velocity[row];
  Braked motion = braked_motion(w, row);
  s.kinetic = 0.5 * m * dot(v, motion.after);
  add_platen(w, row, motion.after, s);
  v.z = motion.after.z = 0.0;
  s.motion_this = half * motion.brake * dot(v, v), s.motion_next = half * motion.brake * dot(v, motion.after);
  if (p.spin.empty() || !w.options.features.rotation) return s;
  const Vec3& spin = p.spin[row];
  const double i = inertia(inertia_factor(w), m, p.radius[row]);
  const Braked turn = braked(w, p.torque[row], spin, w.options.global_damping.rotation, i);
  s.kinetic += 0.5 * i * dot(spin, turn.after);
  s.spin_this = half * turn.brake * dot(spin, spin), s.spin_next = half * turn.brake * dot(spin, turn.after);
  return s;
}

/// A row of a platen that is about to move, in gauges: only where specimens are short.
Vec3 gauge_of_held(const World& w, std::size_t row) {
  if (w.watch.weights.empty() || w.watch.weights[row] == Vec3{}) return {};
  const Vec3 &weight = w.watch.weights[row],
             x = w.particles.position[row] + w.dt * braked_motion(w, row).after;
  return {weight.x * x.x, weight.y * x.y, weight.z * x.z};
}

/// J, of damage in the normal direction, a function of the state. (B52)
double normal_damage(const World& w) {
  if (!w.features.breakage || w.features.criterion == Criterion::coupled) return 0.0;
  std::vector<double> blocks;
  const BondTable& b = w.bonds;
  return with_laws(w.laws, b.law, [&](const auto& law_of) {
    return sum_pair_ranges(
        w.partition, b, w.options.threads, blocks, [&](std::size_t first, std::size_t last) {
          double energy = 0.0;
          for_damaged(w, first, last, [&](std::size_t k) {
            const auto& law = law_of(k);
            const double damage = b.damage_normal[k];
            if (passes_moments<std::decay_t<decltype(law)>> || !(damage > 0.0)) return;
            const BondConstants<double> bond = constants_of_bond(b, k);
            energy += damage_energy(damage, limits_of(law, bond).tension, bond.stiffness,
                                    delta_normal(law.failure, strain_length(law.young, bond)));
          });
          return energy;
        });
  });
}

/// Of forces from outside on listed rows.
/// @param force  of the place in the list, N
template <class Force>
OuterWork work_of_listed(const World& w, std::span<const Row> rows, const Force& force) {
  std::vector<OuterWork> blocks;
  return sum_listed(w.partition, rows, 1, blocks, [&](std::size_t k) {
    const Vec3& f = force(k);
    return OuterWork{0.5 * w.dt * dot(f, w.particles.velocity[rows[k]]),
                     0.5 * w.dt * dot(f, braked_motion(w, rows[k]).after)};
  });
}

/// Added up in the order of ranks: other numbers of ranks differ in the last digits.
Losses losses_of_all(const World& w) {
  const Ranks& ranks = w.partition.ranks;
  const Losses mine = losses_of(w.ledger);
  if (ranks.alone()) return mine;
  Losses sum;
  for (const Losses& loss : gather_elements_everywhere(ranks, std::span(&mine, 1)))
    add(sum.bonds, loss.bonds), add(sum.contacts, loss.contacts);
  return sum;
}

/// The books begin at the forces of the first step: there was no step before it to end with them.
void begin_ledger(World& w, const StepWork& work) {
  EnergyLedger& ledger = w.ledger;
  ledger.start = work.kinetic + stored_energy(w, w.dt);
  ledger.platens.add(0.0, work.held_next);
  ledger.damped_motion.add(0.0, work.motion_next);
  ledger.damped_spin.add(0.0, work.spin_next);
  std::fill(ledger.bonds.begin(), ledger.bonds.end(), BondLosses<double>{});
  std::fill(ledger.contacts.begin(), ledger.contacts.end(), ContactLosses{});
}

}  // namespace

OuterWorks works_from_outside(const World& w) {
  OuterWorks outer;
  const std::vector<Row>& near = w.end_walls.rows;
  if (!near.empty())
    outer.walls += work_of_listed(w, near, [&](std::size_t k) {
      return Vec3{0.0, 0.0, w.end_walls.force[k]};
    });
  if (!w.tool.rows.empty())
    outer.walls += work_of_listed(w, w.tool.rows, [&](std::size_t k) { return w.tool.force[k]; });
  const Confinement& c = w.confinement;
  if (!c.rigid && c.pressure != 0.0) {
    outer.pressure += work_of_listed(w, c.rows, [&](std::size_t k) { return c.force[k]; });
    outer.pressure += work_of_listed(w, c.flying, [&](std::size_t k) { return c.brake[k]; });
  }
  return outer;
}

StepWork move_free(World& w) {
  const Motion motion = motion_of(w);
  const GlobalDamping& damping = w.options.global_damping;
  const bool booked = w.ledger.enabled, single = !w.single.empty();
  const RecordedMotion records = single ? recorded_motion(w) : RecordedMotion{};
  const CollectedSums sums = single ? collected_sums(w) : CollectedSums{};
  const Rows mine = w.partition.owned();
  std::vector<StepWork> blocks;
  return sum_particle_ranges(
      w.partition, w.options.threads, blocks, [&](std::size_t first, std::size_t last) {
        const std::size_t free = std::clamp(w.particles.free, first, last);
        StepWork sum{single ? w.integrate_single(motion, records, sums, first, free, w.dt, damping, booked)
                            : w.integrate_free(motion, first, free, w.dt, damping, booked)};
        if (first == mine.first) sum.events |= w.single.events;  // of the pass over this rank's bonds
        for (std::size_t row = free; row < last; ++row) {
          if (booked) sum += work_on_held(w, row);
          sum.gauge += gauge_of_held(w, row);
        }
        return sum;
      });
}

void enter_step(World& w, const StepWork& work, const OuterWorks& outer) {
  EnergyLedger& ledger = w.ledger;
  ledger.kinetic = work.kinetic;
  if (w.step == 0) return begin_ledger(w, work);
  ledger.platens.add(work.held_this, work.held_next);
  ledger.damped_motion.add(work.motion_this, work.motion_next);
  ledger.damped_spin.add(work.spin_this, work.spin_next);
  ledger.walls.add(outer.walls.over_this, outer.walls.over_next);
  if (!w.confinement.rigid) ledger.pressure.add(outer.pressure.over_this, outer.pressure.over_next);
}

EnergyBalance energy_balance(const World& w) {
  const EnergyLedger& ledger = w.ledger;
  EnergyBalance e;
  e.work = ledger.platens.done + ledger.pressure.done + ledger.walls.done + ledger.start;  // (B49)
  e.kinetic = ledger.kinetic;
  e.stored = stored_energy(w, w.dt);  // (B50)
  const Losses losses = losses_of_all(w);
  const auto& [bonds, contacts] = losses;
  e.plastic = bonds.plastic;
  e.damage = bonds.damage + normal_damage(w);
  e.friction = bonds.friction + contacts.friction;
  e.failure = bonds.failure;
  e.contact_viscous = bonds.viscous + contacts.viscous;
  e.global_damping = ledger.damped_motion.done + ledger.damped_spin.done;  // (B56)
  return e;
}

}  // namespace breccia
