// From the whole world to the part that one rank runs, and contacts from the root to all.
#pragma once
#include "core/world/world.hpp"

namespace breccia {

/// The part of a whole world that one rank runs; the root keeps the whole one beside it.
World distribute(World whole, const Ranks& ranks);

/// The contacts that the root's replica has listed anew, and the step that it has chosen, to every
/// rank.
void broadcast_contacts(World& world);

}  // namespace breccia
