#include "core/world/energy_ledger.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace breccia {
namespace {

BondLosses<double> total_bond_losses(const EnergyLedger& ledger) {
  BondLosses<double> sum;
  for (const BondLosses<double>& loss : std::span(ledger.bonds).first(ledger.owned_bonds)) add(sum, loss);
  return sum;
}

ContactLosses total_contact_losses(const EnergyLedger& ledger) {
  ContactLosses sum = ledger.earlier_contacts;
  for (const ContactLosses& loss : std::span(ledger.contacts).first(ledger.owned_contacts)) add(sum, loss);
  return sum;
}

}  // namespace

EnergyLedger make_ledger(std::size_t bonds) {
  EnergyLedger ledger;
  ledger.enabled = true;
  ledger.bonds.resize(force_blocks(bonds));
  ledger.owned_bonds = ledger.bonds.size();
  return ledger;
}

void start_contact_sums(EnergyLedger& ledger, const ContactTable& contacts) {
  if (!ledger.enabled) return;
  ledger.earlier_contacts = total_contact_losses(ledger);
  ledger.contacts.assign(force_blocks(contacts.padded), {});
  ledger.owned_contacts = force_blocks(contacts.size);
}

void add(BondLosses<double>& sum, const BondLosses<double>& loss) {
  sum.plastic += loss.plastic, sum.viscous += loss.viscous, sum.damage += loss.damage;
  sum.friction += loss.friction, sum.failure += loss.failure;
}

void add(ContactLosses& sum, const ContactLosses& loss) {
  sum.viscous += loss.viscous, sum.friction += loss.friction;
}

Losses losses_of(const EnergyLedger& ledger) {
  return {total_bond_losses(ledger), total_contact_losses(ledger)};
}

void record_balance(EnergyLedger& ledger, const EnergyBalance& e) {
  ledger.most_work = std::max(ledger.most_work, std::abs(e.work));
  ledger.worst_balance = std::max(ledger.worst_balance, std::abs(e.imbalance()));
  for (const auto& [name, channel] : loss_channels)
    ledger.worst_loss = std::max(ledger.worst_loss, -(e.*channel));
}

double energy_error(const EnergyLedger& ledger) {
  // (B57)
  return ledger.most_work > 0.0 ? std::max(ledger.worst_balance, ledger.worst_loss) / ledger.most_work : 0.0;
}

}  // namespace breccia
