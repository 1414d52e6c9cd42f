// Views of a world's tables for the loops: built at the call, dead with it.
#pragma once
#include "core/world/world.hpp"

namespace breccia {

/// What the bond pass reads and what it changes.
BondPassIn bond_pass_in(const World& world);
BondPassHistory bond_pass_history(World& world);

/// The same in single precision, and how its integers and the particles' doubles follow each other.
SinglePassIn single_pass_in(World& world);
RecordedMotion recorded_motion(World& world);
CollectedSums collected_sums(World& world);

/// What the energy of undamaged bonds reads; places as of `back` seconds ago.
BondEnergyIn bond_energy_in(const World& world, double back);

/// The same in single precision.
/// @param back  s, 0 or the last step
SingleEnergyIn single_energy_in(const World& world, double back);

/// Views of all rows of the particles, for integration.
Motion motion_of(World& world);

/// I = factor m r^2
double inertia_factor(const World& world);

/// What contacts of the scene have in their table.
ContactColumns contact_columns(const World& w);

}  // namespace breccia
