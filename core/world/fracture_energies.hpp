// What it costs to part the bonds of a world.
#pragma once
#include "core/world/world.hpp"

namespace breccia {

/// J/m^2 of bond area, mean over the bonds.
struct FractureEnergies {
  double normal = 0;  ///< G_I
  double shear = 0;   ///< G_II
};

/// Energy per area that the bonds need to part; the law's delta fixes it. (B19)
FractureEnergies fracture_energies(const World& world);

}  // namespace breccia
