#include "core/energy_ledger.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "core/world.hpp"
#include "kernels/bond_energy.hpp"

namespace breccia {
namespace {

/// Velocity and spin of a row half a step after the forces.
struct Kicked {
  Vec3 velocity, spin;
};

Vec3 spin_after(const World& w, std::size_t row) {
  const ParticleTable& p = w.particles;
  if (p.spin.empty() || !w.options.features.rotation) return {};
  const Vec3 torque = damped(p.torque[row], p.spin[row], w.options.global_damping.rotation);
  return p.spin[row] + (w.dt / inertia(inertia_factor(w), p.mass[row], p.radius[row])) * torque;
}

Kicked kicked(const World& w, std::size_t row) {
  const ParticleTable& p = w.particles;
  const double alpha = w.options.global_damping.translation;
  const double by_mass = w.dt / p.mass[row];
  if (row < p.free)
    return {p.velocity[row] + by_mass * damped(p.force[row], p.velocity[row], alpha), spin_after(w, row)};
  Vec3 v = w.platens.velocity[row >= w.first_top];
  if (!w.platens.rough) {
    const Vec3 lateral{p.velocity[row].x, p.velocity[row].y, 0.0};
    const Vec3 after = lateral + by_mass * damped({p.force[row].x, p.force[row].y, 0.0}, lateral, alpha);
    v.x = after.x, v.y = after.y;
  }
  return {v, spin_after(w, row)};
}

/// Work over the two half steps around the present forces, J, and the kinetic energy.
struct StepWork {
  double kinetic = 0, held_this = 0, held_next = 0, motion_this = 0, motion_next = 0, spin_this = 0,
         spin_next = 0;
  StepWork& operator+=(const StepWork& o) {
    kinetic += o.kinetic, held_this += o.held_this, held_next += o.held_next;
    motion_this += o.motion_this, motion_next += o.motion_next;
    spin_this += o.spin_this, spin_next += o.spin_next;
    return *this;
  }
};

StepWork work_on(const World& w, std::size_t row) {
  const ParticleTable& p = w.particles;
  const Vec3& v = p.velocity[row];
  const Kicked after = kicked(w, row);
  const double m = p.mass[row], half = 0.5 * w.dt;
  StepWork s;
  s.kinetic = 0.5 * m * dot(v, after.velocity);
  // what acts beside the forces: global damping on a free row, the platen on a held one
  Vec3 beside = (m / w.dt) * (after.velocity - v) - p.force[row];
  Vec3 held{};
  if (row >= p.free) {
    held = w.platens.rough ? beside : Vec3{0.0, 0.0, beside.z};
    beside -= held;
  }
  s.held_this = half * dot(held, v), s.held_next = half * dot(held, after.velocity);
  s.motion_this = -half * dot(beside, v), s.motion_next = -half * dot(beside, after.velocity);
  if (p.spin.empty() || !w.options.features.rotation) return s;
  const Vec3& spin = p.spin[row];
  const double i = inertia(inertia_factor(w), m, p.radius[row]);
  s.kinetic += 0.5 * i * dot(spin, after.spin);
  const Vec3 brake = (i / w.dt) * (after.spin - spin) - p.torque[row];
  s.spin_this = -half * dot(brake, spin), s.spin_next = -half * dot(brake, after.spin);
  return s;
}

/// J, of damage in the normal direction, a function of the state.
double normal_damage(const World& w) {
  if (w.bonds.damage_normal.empty() || w.features.criterion == Criterion::coupled) return 0.0;
  std::vector<double> blocks;
  const BondTable& b = w.bonds;
  return std::visit(
      [&](const auto& law) {
        return sum_rows<double>(b.size, w.options.threads, blocks, [&](std::size_t k) {
          const double damage = b.damage_normal[k];
          if (!(damage > 0.0)) return 0.0;
          const BondConstants<double> bond = constants_of_bond(b, k);
          return damage_energy(damage, limits_of(law, bond).tension, bond.stiffness,
                               delta_normal(law.failure, strain_length(law.young, bond)));
        });
      },
      w.law);
}

/// The books begin at the forces of the first step: there was no step before it to end with them.
void begin_ledger(World& w, const StepWork& work) {
  EnergyLedger& ledger = w.ledger;
  ledger.start = work.kinetic + stored_energy(w);
  ledger.platens.add(0.0, work.held_next);
  ledger.damped_motion.add(0.0, work.motion_next);
  ledger.damped_spin.add(0.0, work.spin_next);
  std::fill(ledger.bonds.begin(), ledger.bonds.end(), BondLosses<double>{});
  std::fill(ledger.contacts.begin(), ledger.contacts.end(), ContactLosses{});
}

}  // namespace

EnergyLedger open_ledger(const World& w) {
  EnergyLedger ledger;
  ledger.enabled = true;
  ledger.bonds.resize((w.bonds.padded + LoadBlock::capacity - 1) / LoadBlock::capacity);
  return ledger;
}

void renew_contacts(EnergyLedger& ledger, std::size_t contacts) {
  if (!ledger.enabled) return;
  for (const ContactLosses& loss : ledger.contacts) {
    ledger.earlier_contacts.viscous += loss.viscous;
    ledger.earlier_contacts.friction += loss.friction;
  }
  ledger.contacts.assign((contacts + LoadBlock::capacity - 1) / LoadBlock::capacity, {});
}

void book_motion(World& w) {
  EnergyLedger& ledger = w.ledger;
  if (!ledger.enabled) return;
  std::vector<StepWork> blocks;
  const StepWork work = sum_rows<StepWork>(w.particles.size, w.options.threads, blocks,
                                           [&](std::size_t row) { return work_on(w, row); });
  ledger.kinetic = work.kinetic;
  if (w.step == 0) return begin_ledger(w, work);
  ledger.platens.add(work.held_this, work.held_next);
  ledger.damped_motion.add(work.motion_this, work.motion_next);
  ledger.damped_spin.add(work.spin_this, work.spin_next);
  if (w.confinement.rigid || w.confinement.rows.empty()) return;
  double over_this = 0.0, over_next = 0.0;
  for (std::size_t k = 0; k < w.confinement.rows.size() && w.confinement.pressure != 0.0; ++k) {
    const Row row = w.confinement.rows[k];
    over_this += 0.5 * w.dt * dot(w.confinement.force[k], w.particles.velocity[row]);
    over_next += 0.5 * w.dt * dot(w.confinement.force[k], kicked(w, row).velocity);
  }
  ledger.pressure.add(over_this, over_next);
}

EnergyBalance balance(const World& w) {
  const EnergyLedger& ledger = w.ledger;
  EnergyBalance e;
  e.work = ledger.platens.done + ledger.pressure.done + ledger.start;
  e.kinetic = ledger.kinetic;
  e.stored = stored_energy(w, w.dt);
  BondLosses<double> bonds;
  for (const BondLosses<double>& loss : ledger.bonds) {
    bonds.plastic += loss.plastic, bonds.viscous += loss.viscous, bonds.damage += loss.damage;
    bonds.friction += loss.friction, bonds.failure += loss.failure;
  }
  ContactLosses contacts = ledger.earlier_contacts;
  for (const ContactLosses& loss : ledger.contacts)
    contacts.viscous += loss.viscous, contacts.friction += loss.friction;
  e.plastic = bonds.plastic;
  e.damage = bonds.damage + normal_damage(w);
  e.friction = bonds.friction + contacts.friction;
  e.failure = bonds.failure;
  e.contact_viscous = bonds.viscous + contacts.viscous;
  e.global_damping = ledger.damped_motion.done + ledger.damped_spin.done;
  return e;
}

void note_balance(EnergyLedger& ledger, const EnergyBalance& e) {
  ledger.most_work = std::max(ledger.most_work, std::abs(e.work));
  ledger.worst_balance = std::max(ledger.worst_balance, std::abs(e.imbalance()));
  for (const auto& [name, channel] : loss_channels)
    ledger.worst_loss = std::max(ledger.worst_loss, -(e.*channel));
}

double energy_error(const EnergyLedger& ledger) {
  return ledger.most_work > 0.0 ? std::max(ledger.worst_balance, ledger.worst_loss) / ledger.most_work : 0.0;
}

}  // namespace breccia
