// Mixed precision keeps history as floats beside the table of bonds, which everybody else reads.
#pragma once
#include "core/world/world.hpp"

namespace breccia {

/// Brings the table of bonds up to date, before anyone looks at it; in full precision it always is.
inline void sync(World& world) { history_to_double(world.single_bonds, 0, world.bonds.padded, world.bonds); }

}  // namespace breccia
