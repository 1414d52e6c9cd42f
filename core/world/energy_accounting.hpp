// Energies of a world, entered into its ledger step by step, and what they add up to.
#pragma once
#include "core/world/world.hpp"

namespace breccia {

/// Accounts for what platens, pressure and global damping do in this step: called when the forces
/// are complete and the velocities are not yet kicked.
void account_motion(World& world);

/// At the end of the last step, of all ranks.
EnergyBalance energy_balance(const World& world);

}  // namespace breccia
