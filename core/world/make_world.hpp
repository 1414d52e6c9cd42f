// A world from an assembly: masses, stiffnesses, the step, boundary, plans and loops.
#pragma once
#include "core/world/world.hpp"

namespace breccia {

/// A specimen at rest, ready to be loaded.
World make_world(const Assembly& assembly, const Material& material, const AreaFactor& factor,
                 const WorldOptions& options);

}  // namespace breccia
