// Who may touch whom while a packing relaxes: every sphere's neighbours, both ways, in an order
// that is always the same.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/packing/region.hpp"

namespace breccia::packing {

struct Neighbours {
  std::vector<std::uint32_t> first, other;  ///< those of i: other[first[i]] to other[first[i + 1] - 1]
};

/// Pairs nearer than reach*(ri + rj) + skin, m. Wide distributions cost no more than narrow ones:
/// cells are as large as a mean sphere and each pair is found by its larger sphere only.
Neighbours find_neighbours(const Region& region, std::span<const Vec3> x, std::span<const double> r,
                           double reach, double skin);

/// Rows in the order of cells about `side` wide: those near in space come near in memory.
std::vector<std::uint32_t> spatial_order(const Region& region, std::span<const Vec3> x, double side);

}  // namespace breccia::packing
