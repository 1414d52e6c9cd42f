// Single precision keeps history beside the tables, which everybody else reads.
#pragma once
#include "core/world/world.hpp"

namespace breccia {

/// Brings the tables up to date, before anyone looks at them; in double precision they always are.
inline void sync(World& world) {
  if (world.single.empty()) return;
  history_to_table(world.single, 0, world.bonds.padded, world.bonds, world.options.threads);
  moves_to_table(world.single, world.particles);
}

}  // namespace breccia
