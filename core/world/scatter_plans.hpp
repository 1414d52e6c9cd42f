// Which range of bonds or contacts adds to which particle.
#pragma once
#include "core/world/world.hpp"

namespace breccia {

/// For the bonds that this rank has.
void plan_bonds(World& world);

/// After the list of contacts was made anew.
void plan_contacts(World& world);

}  // namespace breccia
