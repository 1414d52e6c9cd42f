// The halo: motion of the particles that other ranks' bonds and contacts hold, sent at every step.
#pragma once
#include "core/world/world.hpp"

namespace breccia {

/// Who holds particles of whom, from the bonds and contacts of each rank.
void build_halo(World& world);

/// Motion of the particles that other ranks' bonds and contacts hold goes out to them; it travels
/// while the bonds that need none from elsewhere are passed over.
void start_halo_exchange(World& world);
/// Motion of the other ranks' particles that this one holds comes in, where it is still on its way:
/// before anyone looks at them.
void finish_halo_exchange(World& world);

}  // namespace breccia
