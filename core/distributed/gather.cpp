#include "core/distributed/gather.hpp"

#include <algorithm>
#include <numeric>

#include "core/distributed/halo.hpp"
#include "core/world/sync.hpp"

namespace breccia {
namespace {

/// Rows [first, first + size) of the root's column are those of each rank in turn; its other roles
/// stay.
template <class Table>
void gather_columns(const Ranks& ranks, const Table& mine, Rows rows, Table* whole, bool (*wanted)(Role)) {
  const std::vector<std::size_t> sizes = sizes_of_all(ranks, rows.last - rows.first);
  mine.for_each_column([&](const ColumnInfo& info, const auto& column) {
    if (!wanted(info.role)) return;
    // a rank without rows has no columns, but must take part where others have them
    if (!any(ranks, !column.empty())) return;
    using T = ValueOf<decltype(column)>;
    std::vector<std::size_t> bytes;
    for (const std::size_t size : sizes) bytes.push_back(size * sizeof(T));
    std::vector<T> sent, all(whole ? std::accumulate(sizes.begin(), sizes.end(), std::size_t{0}) : 0);
    for (std::size_t row = rows.first; row < rows.last; ++row) sent.push_back(column[row]);
    gather_at_root(ranks, sent.data(), bytes, all.data());
    if (whole)
      whole->for_each_column([&](const ColumnInfo& other, auto& there) {
        if constexpr (std::is_same_v<T, ValueOf<decltype(there)>>)
          if (other.name == info.name)
            for (std::size_t row = 0; row < all.size(); ++row) there[row] = all[row];
      });
  });
}

bool is_state(Role role) { return role == Role::state; }
bool is_remembered(Role role) { return role == Role::history || role == Role::ledger; }

/// The books of all ranks in those of the root; which block of bonds lost what is no longer known.
void gather_ledger(const Ranks& ranks, const EnergyLedger& mine, EnergyLedger* whole) {
  if (!mine.enabled) return;
  const Losses losses = losses_of(mine);
  const std::vector<Losses> all = gather_elements(ranks, std::span(&losses, 1));
  if (!whole) return;
  std::vector<BondLosses<double>> bonds(whole->bonds.size());
  ContactLosses contacts;
  for (const Losses& l : all) add(bonds.front(), l.bonds), add(contacts, l.contacts);
  const EnergyLedger before = *whole;
  *whole = mine;  // sums over particles are the same on every rank
  whole->bonds = std::move(bonds);
  whole->owned_bonds = before.owned_bonds;
  whole->contacts.assign(before.contacts.size(), {});
  whole->owned_contacts = before.owned_contacts;
  whole->earlier_contacts = contacts;
}

}  // namespace

World& gather_to_root(World& w) {
  World& all = gather_scalars(w);
  if (w.partition.ranks.alone()) return w;
  World* whole = w.replica.get();
  const Ranks& ranks = w.partition.ranks;
  gather_columns(ranks, w.particles, w.partition.owned(), whole ? &whole->particles : nullptr, is_state);
  gather_columns(ranks, w.bonds, {0, w.bonds.size}, whole ? &whole->bonds : nullptr, is_remembered);
  gather_columns(ranks, w.contacts, {0, w.contacts.size}, whole ? &whole->contacts : nullptr, is_remembered);
  return all;
}

World& gather_scalars(World& w) {
  finish_halo_exchange(w);
  sync(w);
  if (w.partition.ranks.alone()) return w;
  World* whole = w.replica.get();
  const Ranks& ranks = w.partition.ranks;
  gather_ledger(ranks, w.ledger, whole ? &whole->ledger : nullptr);
  std::vector<Vec3> push = gather_owned_entries<Vec3>(w.partition, w.confinement.rows, w.confinement.force);
  if (!whole) return w;
  whole->time = w.time;
  whole->step = w.step;
  whole->single.quanta = w.single.quanta;
  whole->single.events = w.single.events;
  whole->single.renewals = w.single.renewals;
  whole->single.coarsenings = w.single.coarsenings;
  whole->dt = w.dt;
  whole->critical_dt = w.critical_dt;
  whole->platens = w.platens;
  whole->confinement = w.confinement;
  whole->confinement.force = std::move(push);
  whole->phases = w.phases;
  whole->neighbour_list.next_check = w.neighbour_list.next_check;
  return *whole;
}

World& root_replica(World& w) { return w.replica ? *w.replica : w; }

const World& root_replica(const World& w) { return w.replica ? *w.replica : w; }

std::size_t collect_cracks(World& w, double axial_strain) {
  CrackRecord& mine = w.cracks;
  if (!mine.enabled) return 0;
  const Ranks& ranks = w.partition.ranks;
  if (ranks.alone()) {
    const std::size_t fresh = mine.cracks.size() - mine.collected;
    for (Crack& crack : std::span(mine.cracks).last(fresh)) crack.axial_strain = axial_strain;
    mine.collected = mine.cracks.size();
    return fresh;
  }
  std::vector<Crack> fresh = gather_elements(ranks, std::span<const Crack>(mine.cracks));
  const std::vector<std::size_t> missed = sizes_of_all(ranks, mine.missed);
  mine.cracks.clear();
  mine.missed = 0;
  if (!w.replica) return 0;
  w.replica->cracks.missed += std::accumulate(missed.begin(), missed.end(), std::size_t{0});
  // ranks have bonds in rising order: of one moment they stand in the order of the whole table
  // already
  std::stable_sort(fresh.begin(), fresh.end(),
                   [](const Crack& a, const Crack& b) { return a.time < b.time; });
  for (Crack& crack : fresh) crack.axial_strain = axial_strain;
  std::vector<Crack>& all = w.replica->cracks.cracks;
  all.insert(all.end(), fresh.begin(), fresh.end());
  w.replica->cracks.collected = all.size();  // for one rank that takes up the run from a checkpoint
  return fresh.size();
}

}  // namespace breccia
