// The step of a world: chosen at the start, looked at again when pairs that may touch are listed
// anew, and lowered where they ask for it. docs/model.md, "Time step and mass scaling".
#pragma once
#include "core/world/world.hpp"

namespace breccia {

/// Sets scaled masses, dashpots, critical step and step of a world whose bonds are complete.
/// @throws BadInput when the safety asked for is beyond 1
void choose_step(World& world);

/// After the contacts have been listed anew: sets their dashpots, and lowers the step, never raises
/// it, where it is no longer below the critical one. The step stands while contacts that were not
/// counted before cannot, by a proven bound, use up the margin that there was; only then is the
/// network looked at again.
void revise_step(World& world);

/// The dashpots of all bonds and contacts for the step in use.
void set_dashpots(World& world);

}  // namespace breccia
