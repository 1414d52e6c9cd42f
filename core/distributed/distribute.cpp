#include "core/distributed/distribute.hpp"

#include "core/distributed/halo.hpp"
#include "core/ranks/pairs_of_rank.hpp"
#include "core/world/loop_views.hpp"
#include "core/world/scatter_plans.hpp"
#include "core/world/single_precision.hpp"
#include "core/world/stable_step.hpp"

namespace breccia {

World distribute(World all, const Ranks& ranks) {
  const auto whole = std::make_shared<World>(std::move(all));
  World w = *whole;
  w.partition = partition_of_rank(whole->particles.size, whole->bonds, ranks);
  const PairsOfRank bonds = pairs_of_rank(w.partition, whole->bonds);
  w.bonds = part_of_bonds(whole->bonds, bonds);
  plan_bonds(w);
  fill_single(w);
  w.partition.interface_blocks = interface_blocks_of(w.partition, w.bonds);
  w.cracks = make_crack_record(w.cracks.enabled, w.options.threads, w.bonds.padded);
  if (w.ledger.enabled) {
    const Losses before = losses_of(whole->ledger);
    w.ledger.bonds.assign(std::max<std::size_t>(1, w.bonds.padded / ForceBuffer::capacity), {});
    w.ledger.owned_bonds = std::max<std::size_t>(1, force_blocks(w.bonds.size));
    w.ledger.earlier_contacts = {};
    if (ranks.is_root()) {
      w.ledger.bonds.front() = before.bonds;
      w.ledger.earlier_contacts = before.contacts;
    }
  }
  const PairsOfRank contacts = pairs_of_rank(w.partition, whole->contacts);
  w.contacts = part_of_contacts(whole->contacts, contacts);
  w.ledger.contacts.clear();
  w.ledger.owned_contacts = 0;
  start_contact_sums(w.ledger, w.contacts);
  plan_contacts(w);
  build_halo(w);
  if (ranks.is_root()) {
    forget_blocks(whole->single);  // its tables are brought up to date from those of the ranks
    w.replica = whole;
  }
  return w;
}

void broadcast_contacts(World& w) {
  const Ranks& ranks = w.partition.ranks;
  World* whole = w.replica.get();
  struct Step {
    double dt, critical_dt, slack;
    std::uint64_t looks, local_looks, rebuilds, contacts;
  } step{};
  if (whole)
    step = {whole->dt,
            whole->critical_dt,
            whole->neighbour_list.slack,
            whole->step_monitor.looks,
            whole->step_monitor.local_looks,
            whole->neighbour_list.rebuilds,
            whole->contacts.size};
  broadcast(ranks, &step, sizeof(step));
  ContactTable listed;
  if (whole) {
    listed = whole->contacts;
  } else {
    listed = contact_table(step.contacts, contact_columns(w));
  }
  listed.for_each_column([&]<class T>(const ColumnInfo&, Column<T>& column) {
    broadcast(ranks, column.data(), column.size() * sizeof(T));
  });
  const bool lowered = step.dt != w.dt;
  w.dt = step.dt;
  w.critical_dt = step.critical_dt;
  w.step_monitor.looks = step.looks;
  w.step_monitor.local_looks = step.local_looks;
  w.neighbour_list.slack = step.slack;
  w.neighbour_list.rebuilds = step.rebuilds;
  w.neighbour_list.next_search += static_cast<std::uint64_t>(w.neighbour_list.every);
  w.neighbour_list.awake = true;
  w.neighbour_list.position = w.particles.position.copy();
  const PairsOfRank contacts = pairs_of_rank(w.partition, listed);
  w.contacts = part_of_contacts(listed, contacts);
  start_contact_sums(w.ledger, w.contacts);
  if (lowered) set_dashpots(w);
  plan_contacts(w);
  build_halo(w);
  start_halo_exchange(w);  // those met for the first time have not moved here yet
}

}  // namespace breccia
