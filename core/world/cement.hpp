// Bonds of cement, which pass moments: docs/model.md, "Parallel bond".
#pragma once
#include "core/world/world.hpp"

namespace breccia {

/// Brings the couple of an intact bond up to date, and breaks the bond where its cement gives way
/// (B123) (B124).
/// @param notes   of fresh breaks, or null
/// @param booked  whether the ledger is to take what is lost
/// @returns false where no moment acts
bool bend(World& world, std::size_t bond, BreakNotes* notes, bool booked);

/// Of a bond that its pull or its shear alone have broken.
void drop_moment(World& world, std::size_t bond, bool booked);

/// J, in the moment of an intact bond.
double moment_energy(const World& world, std::size_t bond);

}  // namespace breccia
