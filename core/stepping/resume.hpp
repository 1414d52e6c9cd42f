// A world that goes on from a checkpoint: made from its case, filled with what was saved, taken up
// here.
#pragma once
#include <span>
#include <vector>

#include "core/world/world.hpp"

namespace breccia {

/// Makes the table of contacts for pairs of these ids in the order of a search, with ids, rows and
/// arms; all else is zero.
/// @returns for each pair its row in the table
/// @throws BadInput when the world has no particle of such an id
std::vector<Row> list_contacts(World& world, std::span<const Gid> lo, std::span<const Gid> hi);

/// When columns and numbers have been brought back: dashpots, narrow columns and plans that follow
/// from them.
void restore(World& world);

}  // namespace breccia
