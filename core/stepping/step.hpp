// The step.
#pragma once
#include "core/world/world.hpp"

namespace breccia {

/// One step: forces at the present positions, then kick and drift. Before it positions, forces and
/// history belong to the moment n - 1 and n; velocities always to n - 1/2.
void advance(World& world);

}  // namespace breccia
