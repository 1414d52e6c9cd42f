// Bonds grouped by colour: no two bonds of a colour share a particle, so that all of them can be
// summed at once with plain adds.
#pragma once
#include <vector>

#include "core/tables/bond_table.hpp"

namespace breccia {

struct ColouredBonds {
  BondTable bonds;                 ///< colour after colour, each padded to whole batches
  std::vector<std::size_t> first;  ///< row of each colour's first bond, and the end of the last colour
  std::vector<Row> source;         ///< row in the table that each bond was copied from; padding has one too
};

/// Greedy: each bond gets the first colour that neither of its ends has yet, in the order of the
/// table, which is kept within a colour.
ColouredBonds colour_bonds(const BondTable& bonds, std::size_t particles);

}  // namespace breccia
