// What single precision asks for before a step.
#pragma once
#include "core/world/world.hpp"

namespace breccia {

/// Before a step: a quantum of force that has become too fine is made coarser, on all ranks at
/// once, which know of each other's events. Nothing in double precision.
/// @throws SimulationBroke  where a step was too wild
void look_at_single(World& world);

}  // namespace breccia
