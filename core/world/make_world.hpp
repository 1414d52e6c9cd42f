// A world from an assembly: masses, stiffnesses, the step, boundary, plans and loops.
#pragma once
#include <span>

#include "core/bonding/several_materials.hpp"
#include "core/world/world.hpp"

namespace breccia {

/// A specimen at rest, ready to be loaded.
/// @param others  materials beside it, in the order of the column `material`, the first is 1
World make_world(const Assembly& assembly, const Material& material, const AreaFactor& factor,
                 const WorldOptions& options, std::span<const BondMaterial> others = {});

}  // namespace breccia
