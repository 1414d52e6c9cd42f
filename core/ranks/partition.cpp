#include "core/ranks/partition.hpp"

#include <numeric>

#include "core/world/world.hpp"

namespace breccia {
namespace {

std::size_t rows_of_block(std::size_t rows) {
  return std::clamp<std::size_t>((rows / 2048 + 63) / 64 * 64, 64, 1024);
}

/// Cuts rows into parts of equal work, at blocks; work: bonds, and a little for the particle itself.
std::vector<std::size_t> equal_parts(const World& w, std::size_t block, int count) {
  const std::size_t n = w.particles.size;
  std::vector<double> work((n + block - 1) / block, 0.0);
  for (std::size_t row = 0; row < n; ++row) work[row / block] += 1.0;
  for (std::size_t k = 0; k < w.bonds.size; ++k)
    work[std::min(w.bonds.row_lo[k], w.bonds.row_hi[k]) / block] += 1.0;
  const double total = std::accumulate(work.begin(), work.end(), 0.0);
  std::vector<std::size_t> bounds{0};
  double sum = 0.0;
  for (std::size_t b = 0; b < work.size(); ++b) {
    // a block goes to the part in which its middle lies
    const double wanted = total * static_cast<double>(bounds.size()) / count;
    if (static_cast<int>(bounds.size()) < count && b > 0 && sum + 0.5 * work[b] > wanted)
      bounds.push_back(b * block);
    sum += work[b];
  }
  bounds.resize(static_cast<std::size_t>(count), n);  // more ranks than blocks: the last have nothing
  bounds.push_back(n);
  return bounds;
}

/// Which rows of a whole table of pairs a rank takes, and in which order: those that it owns, padding to a
/// whole batch, copies of those that only end in its part, padding.
struct PairsOfRank {
  std::vector<std::size_t> rows;  ///< `none`: padding
  std::size_t owned = 0;
  static constexpr std::size_t none = ~std::size_t{0};
};

template <class Table>
PairsOfRank pairs_of_rank(const Partition& s, const Table& t) {
  PairsOfRank pairs;
  const Rows mine = s.owned();
  const auto is_mine = [&](Row row) { return row >= mine.first && row < mine.last; };
  std::vector<std::size_t> copies;
  for (std::size_t k = 0; k < t.size; ++k) {
    const auto [low, high] = std::minmax(t.row_lo[k], t.row_hi[k]);
    if (is_mine(low))
      pairs.rows.push_back(k);
    else if (is_mine(high))
      copies.push_back(k);
  }
  pairs.owned = pairs.rows.size();
  const auto pad = [&] {
    while (pairs.rows.size() % ForceBuffer::capacity != 0) pairs.rows.push_back(PairsOfRank::none);
  };
  pad();
  pairs.rows.insert(pairs.rows.end(), copies.begin(), copies.end());
  pad();
  return pairs;
}

/// A table of these rows of another one.
template <class Table>
Table part_of_table(const Table& whole, const PairsOfRank& pairs) {
  Table t;
  t.size = pairs.owned;
  t.padded = pairs.rows.size();
  t.for_each_column([&]<class T>(const ColumnInfo& info, Column<T>& column) {
    whole.for_each_column([&]<class U>(const ColumnInfo& other, const Column<U>& from) {
      if constexpr (std::is_same_v<T, U>) {
        if (other.name != info.name || from.empty()) return;
        column.reserve(t.padded);
        for (const std::size_t k : pairs.rows) column.push_back(k == PairsOfRank::none ? T{} : from[k]);
      }
    });
  });
  return t;
}

/// Padding has no stiffness, but is computed like the rest: a place, a length and an area that are numbers.
BondTable part_of_bonds(const BondTable& whole, const PairsOfRank& pairs) {
  BondTable b = part_of_table(whole, pairs);
  if (whole.size == 0) return b;
  for (std::size_t k = 0; k < b.padded; ++k) {
    if (pairs.rows[k] != PairsOfRank::none) continue;
    b.row_lo[k] = whole.row_lo[0], b.row_hi[k] = whole.row_hi[0];
    b.rest_length[k] = whole.rest_length[0], b.area[k] = whole.area[0];
    if (!b.strength_area.empty()) b.strength_area[k] = whole.strength_area[0];
  }
  return b;
}

template <class Table>
void add_foreign_ends(const Partition& s, const Table& t, std::vector<std::vector<Row>>& wanted) {
  for (std::size_t k = 0; k < t.padded; ++k) {
    if (t.stiffness[k] == 0.0) continue;  // padding holds on to nobody
    for (const Row row : {t.row_lo[k], t.row_hi[k]})
      if (const int owner = s.owner(row); owner != s.ranks.rank)
        wanted[static_cast<std::size_t>(owner)].push_back(row);
  }
}

/// Blocks of bonds of which one at least ends in another rank's part.
std::vector<char> interface_blocks_of(const Partition& s, const BondTable& b) {
  const Rows mine = s.owned();
  const auto is_mine = [&](Row row) { return row >= mine.first && row < mine.last; };
  std::vector<char> reaching((b.padded + ForceBuffer::capacity - 1) / ForceBuffer::capacity, 0);
  for (std::size_t k = 0; k < b.padded; ++k)
    if (b.stiffness[k] > 0.0 && !(is_mine(b.row_lo[k]) && is_mine(b.row_hi[k])))
      reaching[k / ForceBuffer::capacity] = 1;
  return reaching;
}

std::size_t numbers_of_row(const ParticleTable& p) { return p.spin.empty() ? 6 : 9; }

void build_halo(World& w) {
  Partition& s = w.partition;
  std::vector<std::vector<Row>> wanted(static_cast<std::size_t>(s.ranks.count));
  add_foreign_ends(s, w.bonds, wanted);
  add_foreign_ends(s, w.contacts, wanted);
  s.neighbours.clear();
  for (int rank = 0; rank < s.ranks.count; ++rank) {
    if (rank == s.ranks.rank) continue;
    std::vector<Row>& rows = wanted[static_cast<std::size_t>(rank)];
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    s.neighbours.push_back({rank, {}, std::move(rows), {}, {}});
  }
  exchange_send_lists(s.ranks, s.neighbours);
  for (Neighbour& n : s.neighbours) {
    n.outgoing.resize(n.send.size() * numbers_of_row(w.particles));
    n.incoming.resize(n.receive.size() * numbers_of_row(w.particles));
  }
}

/// Rows [first, first + size) of the root's column are those of each rank in turn; its other roles stay.
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

void plan_bonds(World& w) {
  w.bond_plan =
      plan_scatter(w.options.scatter, w.options.threads, ForceBuffer::capacity, w.bonds.row_lo, w.bonds.row_hi,
                   w.bonds.gid_lo, w.bonds.gid_hi, w.bonds.arm_offset, w.particles.size);
}

}  // namespace

Partition serial_partition(std::size_t rows) {
  Partition s;
  s.rows = rows;
  s.block = rows_of_block(rows);
  s.bounds = {0, rows};
  return s;
}

Partition partition_of_rank(const World& whole, const Ranks& ranks) {
  Partition s = serial_partition(whole.particles.size);
  s.ranks = ranks;
  s.bounds = equal_parts(whole, s.block, ranks.count);
  return s;
}

World distribute(World all, const Ranks& ranks) {
  const auto whole = std::make_shared<World>(std::move(all));
  World w = *whole;
  w.partition = partition_of_rank(*whole, ranks);
  const PairsOfRank bonds = pairs_of_rank(w.partition, whole->bonds);
  w.bonds = part_of_bonds(whole->bonds, bonds);
  if (w.options.precision == Precision::mixed) w.single_bonds = single_bonds(w.bonds);
  plan_bonds(w);
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
  w.contacts = part_of_table(whole->contacts, contacts);
  w.ledger.contacts.clear();
  w.ledger.owned_contacts = 0;
  renew_contacts(w.ledger, w.contacts);
  plan_contacts(w);
  build_halo(w);
  if (ranks.is_root()) {
    whole->single_bonds = {};  // its table of bonds is brought up to date from those of the ranks
    w.partition.whole = whole;
  }
  return w;
}

World& gather_to_root(World& w) {
  World& all = gather_scalars(w);
  if (w.partition.ranks.alone()) return w;
  World* whole = w.partition.whole.get();
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
  World* whole = w.partition.whole.get();
  const Ranks& ranks = w.partition.ranks;
  gather_ledger(ranks, w.ledger, whole ? &whole->ledger : nullptr);
  std::vector<Vec3> push = gather_owned_entries<Vec3>(w.partition, w.confinement.rows, w.confinement.force);
  if (!whole) return w;
  whole->time = w.time;
  whole->step = w.step;
  whole->dt = w.dt;
  whole->critical_dt = w.critical_dt;
  whole->platens = w.platens;
  whole->confinement = w.confinement;
  whole->confinement.force = std::move(push);
  whole->phases = w.phases;
  whole->neighbour_list.next_check = w.neighbour_list.next_check;
  return *whole;
}

World& root_replica(World& w) { return w.partition.whole ? *w.partition.whole : w; }

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
  if (!w.partition.whole) return 0;
  w.partition.whole->cracks.missed += std::accumulate(missed.begin(), missed.end(), std::size_t{0});
  // ranks have bonds in rising order: of one moment they stand in the order of the whole table already
  std::stable_sort(fresh.begin(), fresh.end(),
                   [](const Crack& a, const Crack& b) { return a.time < b.time; });
  for (Crack& crack : fresh) crack.axial_strain = axial_strain;
  std::vector<Crack>& all = w.partition.whole->cracks.cracks;
  all.insert(all.end(), fresh.begin(), fresh.end());
  w.partition.whole->cracks.collected = all.size();  // for one rank that takes up the run from a checkpoint
  return fresh.size();
}

void broadcast_contacts(World& w) {
  const Ranks& ranks = w.partition.ranks;
  World* whole = w.partition.whole.get();
  struct Step {
    double dt, critical_dt, slack;
    std::uint64_t looks, rebuilds, contacts;
  } step{};
  if (whole)
    step = {whole->dt,
            whole->critical_dt,
            whole->neighbour_list.slack,
            whole->step_monitor.looks,
            whole->neighbour_list.rebuilds,
            whole->contacts.size};
  broadcast(ranks, &step, sizeof(step));
  ContactTable listed;
  if (whole) {
    listed = whole->contacts;
  } else {
    listed.resize(step.contacts, w.features);
    if (w.ledger.enabled) listed.viscous_force.assign(listed.padded, 0.0);
  }
  listed.for_each_column([&]<class T>(const ColumnInfo&, Column<T>& column) {
    broadcast(ranks, column.data(), column.size() * sizeof(T));
  });
  const bool lowered = step.dt != w.dt;
  w.dt = step.dt;
  w.critical_dt = step.critical_dt;
  w.step_monitor.looks = step.looks;
  w.neighbour_list.slack = step.slack;
  w.neighbour_list.rebuilds = step.rebuilds;
  w.neighbour_list.awake = true;
  w.neighbour_list.position = w.particles.position.copy();
  const PairsOfRank contacts = pairs_of_rank(w.partition, listed);
  w.contacts = part_of_table(listed, contacts);
  renew_contacts(w.ledger, w.contacts);
  if (lowered) set_dashpots(w);
  plan_contacts(w);
  build_halo(w);
  start_halo_exchange(w);  // those met for the first time have not moved here yet
}

void start_halo_exchange(World& w) {
  std::vector<Neighbour>& neighbours = w.partition.neighbours;
  if (neighbours.empty()) return;
  const Lap lap(w.phases, Phase::halo);
  const ParticleTable& p = w.particles;
  const bool spins = !p.spin.empty();
  for (Neighbour& n : neighbours) {
    double* to = n.outgoing.data();
    for (const Row row : n.send) {
      for (const Vec3* v : {&p.position[row], &p.velocity[row]}) *to++ = v->x, *to++ = v->y, *to++ = v->z;
      if (spins) *to++ = p.spin[row].x, *to++ = p.spin[row].y, *to++ = p.spin[row].z;
    }
  }
  begin_exchange(neighbours);
}

void finish_halo_exchange(World& w) {
  if (w.partition.neighbours.empty()) return;
  const Lap lap(w.phases, Phase::halo);
  if (!finish_exchange()) return;
  ParticleTable& p = w.particles;
  const bool spins = !p.spin.empty();
  for (Neighbour& n : w.partition.neighbours) {
    const double* from = n.incoming.data();
    const auto next = [&] {
      from += 3;
      return Vec3{from[-3], from[-2], from[-1]};
    };
    for (const Row row : n.receive) {
      p.position[row] = next();
      p.velocity[row] = next();
      if (spins) p.spin[row] = next();
      p.force[row] = {};  // what the loops have added here belongs to nobody
      if (spins) p.torque[row] = {};
    }
  }
}

}  // namespace breccia
