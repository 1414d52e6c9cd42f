// What single precision asks for from time to time.
#pragma once
#include "core/world/world.hpp"

namespace breccia {

/// Every few steps: a quantum of force that has become too fine is made coarser, on all ranks at
/// the same step. Nothing in double precision.
/// @throws SimulationBroke  where a step was too wild
void look_at_single(World& world);

}  // namespace breccia
