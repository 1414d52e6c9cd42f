// Which bonds or contacts of a whole table a rank takes, and the table of them: those that it owns,
// padding to a whole batch, ghosts that only end in its part, padding.
#pragma once
#include "core/ranks/partition.hpp"
#include "core/tables/contact_table.hpp"

namespace breccia {

struct PairsOfRank {
  std::vector<std::size_t> rows;  ///< of the whole table, in the order that the rank has; no_row: padding
  std::size_t owned = 0;
};

PairsOfRank pairs_of_rank(const Partition& partition, const BondTable& bonds);
PairsOfRank pairs_of_rank(const Partition& partition, const ContactTable& contacts);

/// A table of these rows of a whole one. Padding among bonds has no stiffness, but is computed like
/// the rest: it has a place, a length and an area that are numbers.
BondTable part_of_bonds(const BondTable& whole, const PairsOfRank& pairs);
ContactTable part_of_contacts(const ContactTable& whole, const PairsOfRank& pairs);

/// Per block of bonds: true where one ends in another rank's part.
std::vector<char> interface_blocks_of(const Partition& partition, const BondTable& bonds);

/// Adds the ends of a rank's bonds or contacts that another rank owns to what is wanted of that
/// rank.
void add_foreign_ends(const Partition& partition, const BondTable& bonds,
                      std::vector<std::vector<Row>>& wanted);
void add_foreign_ends(const Partition& partition, const ContactTable& contacts,
                      std::vector<std::vector<Row>>& wanted);

}  // namespace breccia
