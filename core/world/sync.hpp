// Single precision keeps history beside the tables, which everybody else reads.
#pragma once
#include <algorithm>

#include "core/world/world.hpp"

namespace breccia {

/// Brings the tables up to date, before anyone looks at them; in double precision they always are.
inline void sync(World& world) {
  if (world.single.empty()) return;
  history_to_table(world.single, 0, world.bonds.padded, world.bonds, world.options.threads);
  moves_to_table(world.single, world.particles);
}

/// The same for bonds that are damaged alone, which is all that counts and energies of a row look
/// at.
inline void sync_damaged(World& world) {
  const auto blocks = world.single.damaged.size();
  for (std::size_t block = 0; block < blocks; ++block)
    if (world.single.damaged[block] != 0)
      history_to_table(world.single, bond_block * block,
                       std::min(bond_block * (block + 1), world.bonds.padded), world.bonds);
}

}  // namespace breccia
