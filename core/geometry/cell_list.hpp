// Pairs of spheres that are near each other, by a list of cells.
#pragma once
#include <span>
#include <vector>

#include "core/tables/column.hpp"
#include "kernels/math/strided.hpp"

namespace breccia {

struct RowPair {
  Row a, b;  ///< a < b
  constexpr bool operator==(const RowPair&) const = default;
};

/// All pairs with |x_b - x_a| <= (1 + relative)(r_a + r_b) + absolute, in an order that depends on
/// positions only.
/// @param relative  1, above -1
/// @param absolute  m
std::vector<RowPair> near_pairs(Strided<const Vec3> position, std::span<const double> radius, double relative,
                                double absolute, int threads);

}  // namespace breccia
