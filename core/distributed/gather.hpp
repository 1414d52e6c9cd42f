// What the root keeps of a run of several ranks: a replica of the whole world, brought up to date
// when somebody needs it (contacts, pictures, messages).
#pragma once
#include "core/world/world.hpp"

namespace breccia {

/// Brings what has changed since to the root's replica. @returns it; elsewhere the world itself, as
/// stale as it is
World& gather_to_root(World& world);

/// Brings all but the tables of particles, bonds and contacts: clock, platens, confinement, ledger.
World& gather_scalars(World& world);

/// The root's replica, as it was brought together last; of one rank the world itself.
World& root_replica(World& world);
const World& root_replica(const World& world);

/// Takes the cracks of all ranks since the last call into the whole record, in the order of time
/// and of bonds, as of a row of the curve with this strain. @returns how many
std::size_t collect_cracks(World& world, double axial_strain);

}  // namespace breccia
