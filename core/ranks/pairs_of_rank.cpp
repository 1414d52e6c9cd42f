#include "core/ranks/pairs_of_rank.hpp"

#include "core/tables/part_of_table.hpp"
#include "kernels/loops/scatter_block.hpp"

namespace breccia {
namespace {

template <class Table>
PairsOfRank pairs_in(const Partition& s, const Table& t) {
  PairsOfRank pairs;
  const Rows mine = s.owned();
  const auto is_mine = [&](Row row) { return row >= mine.first && row < mine.last; };
  std::vector<std::size_t> ghosts;
  for (std::size_t k = 0; k < t.size; ++k) {
    const auto [low, high] = std::minmax(t.row_lo[k], t.row_hi[k]);
    if (is_mine(low))
      pairs.rows.push_back(k);
    else if (is_mine(high))
      ghosts.push_back(k);
  }
  pairs.owned = pairs.rows.size();
  const auto pad = [&] {
    while (pairs.rows.size() % ForceBuffer::capacity != 0) pairs.rows.push_back(no_row);
  };
  pad();
  pairs.rows.insert(pairs.rows.end(), ghosts.begin(), ghosts.end());
  pad();
  return pairs;
}

template <class Table>
void add_ends_in(const Partition& s, const Table& t, std::vector<std::vector<Row>>& wanted) {
  for (std::size_t k = 0; k < t.padded; ++k) {
    if (t.stiffness[k] == 0.0) continue;  // padding holds on to nobody
    for (const Row row : {t.row_lo[k], t.row_hi[k]})
      if (const int owner = s.owner(row); owner != s.ranks.rank)
        wanted[static_cast<std::size_t>(owner)].push_back(row);
  }
}

}  // namespace

PairsOfRank pairs_of_rank(const Partition& partition, const BondTable& bonds) {
  return pairs_in(partition, bonds);
}

PairsOfRank pairs_of_rank(const Partition& partition, const ContactTable& contacts) {
  return pairs_in(partition, contacts);
}

BondTable part_of_bonds(const BondTable& whole, const PairsOfRank& pairs) {
  BondTable b = part_of_table(whole, pairs.rows, pairs.owned);
  if (whole.size == 0) return b;
  for (std::size_t k = 0; k < b.padded; ++k) {
    if (pairs.rows[k] != no_row) continue;
    b.row_lo[k] = whole.row_lo[0], b.row_hi[k] = whole.row_hi[0];
    b.rest_length[k] = whole.rest_length[0], b.area[k] = whole.area[0];
    if (!b.strength_area.empty()) b.strength_area[k] = whole.strength_area[0];
  }
  return b;
}

ContactTable part_of_contacts(const ContactTable& whole, const PairsOfRank& pairs) {
  return part_of_table(whole, pairs.rows, pairs.owned);
}

std::vector<char> interface_blocks_of(const Partition& s, const BondTable& b) {
  const Rows mine = s.owned();
  const auto is_mine = [&](Row row) { return row >= mine.first && row < mine.last; };
  std::vector<char> reaching((b.padded + ForceBuffer::capacity - 1) / ForceBuffer::capacity, 0);
  for (std::size_t k = 0; k < b.padded; ++k)
    if (b.stiffness[k] > 0.0 && !(is_mine(b.row_lo[k]) && is_mine(b.row_hi[k])))
      reaching[k / ForceBuffer::capacity] = 1;
  return reaching;
}

void add_foreign_ends(const Partition& partition, const BondTable& bonds,
                      std::vector<std::vector<Row>>& wanted) {
  add_ends_in(partition, bonds, wanted);
}

void add_foreign_ends(const Partition& partition, const ContactTable& contacts,
                      std::vector<std::vector<Row>>& wanted) {
  add_ends_in(partition, contacts, wanted);
}

}  // namespace breccia
