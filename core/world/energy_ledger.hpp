// Where the energy of a run comes from and where it goes: docs/model.md, "Energy ledger". The
// scheme changes the kinetic energy K(n) = 1/2 sum m v(n-1/2).v(n+1/2) by the trapezoid
// 1/2 (F(n-1) + F(n)).dx of every force, exactly (B48); every work and every loss is booked by
// that trapezoid, so that what does not balance is an error of the step.
#pragma once
#include <array>
#include <string_view>
#include <vector>

#include "core/boundary/platens_and_confinement.hpp"
#include "core/tables/contact_table.hpp"
#include "kernels/loops/contact_pass.hpp"
#include "kernels/loops/integrate.hpp"

namespace breccia {

/// (B48): the trapezoid of a force in two halves: its work at the end of step n over dx(n) is known
/// at once, that over dx(n+1) belongs to the step to come.
struct TrapezoidSum {
  double done = 0;     ///< J, up to the present step
  double pending = 0;  ///< J, the half that the next step begins with
  void add(double over_this, double over_next) {
    done += pending + over_this;
    pending = over_next;
  }
};

/// Energies at the end of the last step, J.
struct EnergyBalance {
  double work = 0;  ///< put in by platens, prescribed motion and pressure, and what there was at the start
  double kinetic = 0, stored = 0;
  double plastic = 0, damage = 0, friction = 0, failure = 0, contact_viscous = 0, global_damping = 0;

  double dissipated() const {
    return plastic + damage + friction + failure + contact_viscous + global_damping;
  }
  /// What is missing, J.
  double imbalance() const { return work - kinetic - stored - dissipated(); }
};

/// The channels that can only grow.
inline constexpr std::array<std::pair<std::string_view, double EnergyBalance::*>, 6> loss_channels{
    {{"plastic", &EnergyBalance::plastic},
     {"damage", &EnergyBalance::damage},
     {"friction", &EnergyBalance::friction},
     {"failure", &EnergyBalance::failure},
     {"contact viscous", &EnergyBalance::contact_viscous},
     {"global damping", &EnergyBalance::global_damping}}};

struct EnergyLedger {
  bool enabled = false;
  std::vector<BondLosses<double>> bonds;  ///< a sum for each 64 bonds
  std::vector<ContactLosses> contacts;    ///< a sum for each 64 contacts of the present list
  ContactLosses earlier_contacts;         ///< of the lists before
  /// Of these sums, those that count here: behind them come copies of what other ranks own
  std::size_t owned_bonds = 0, owned_contacts = 0;
  TrapezoidSum platens, pressure, walls;  ///< work in
  TrapezoidSum damped_motion, damped_spin;
  double kinetic = 0;  ///< J, at the end of the last step
  double start = 0;    ///< J, kinetic and stored at the first forces

  double most_work = 0;      ///< J, largest of the work put in plus what there was at the start
  double worst_balance = 0;  ///< J, largest imbalance found so far
  double worst_loss = 0;     ///< J, by which a channel that can only grow has been below zero
};

/// Sums over a number of bonds or contacts: one for each block of the loop.
inline std::size_t force_blocks(std::size_t rows) {
  return (rows + ForceBuffer::capacity - 1) / ForceBuffer::capacity;
}

/// What bonds and contacts have lost, J.
struct Losses {
  BondLosses<double> bonds;
  ContactLosses contacts;
};

/// Of this rank.
Losses losses_of(const EnergyLedger& ledger);
void add(BondLosses<double>& sum, const BondLosses<double>& loss);
void add(ContactLosses& sum, const ContactLosses& loss);

/// Nothing accounted for yet.
/// @param bonds  rows of the loop, with padding
EnergyLedger make_ledger(std::size_t bonds);

/// After the list of contacts was made anew: sums of its own, those before are kept as one.
void start_contact_sums(EnergyLedger& ledger, const ContactTable& contacts);

/// Takes note of a balance; the errors below are the largest of all that were noted.
void record_balance(EnergyLedger& ledger, const EnergyBalance& balance);

/// The larger of imbalance and negative dissipation, over the work put in. 0 while there was none.
/// (B57)
double energy_error(const EnergyLedger& ledger);

}  // namespace breccia
