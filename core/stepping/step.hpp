// The step.
#pragma once
#include "core/world/world.hpp"

namespace breccia {

/// One step: forces at the present positions, then kick (P2) (P9) and drift (P7). Between two calls
/// positions stand at n, velocities and spins at n - 1/2, and forces and what bonds remember at
/// n - 1, where they were last summed; `time` and `step` are those of n.
void advance(World& world);

}  // namespace breccia
