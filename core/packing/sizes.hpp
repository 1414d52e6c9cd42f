// Radii that follow a size distribution.
#pragma once
#include <vector>

#include "core/base/random.hpp"
#include "core/packing/packing.hpp"

namespace breccia::packing {

/// Throws BadInput when the law is empty, unordered or impossible.
void check_sizes(const SizeDistribution& sizes);

/// n relative radii, largest first. Stratified: one draw in each of n equal slices of probability, so that a
/// small packing follows the law as closely as a large one.
/// @param space  sieves: the mass of a sphere goes with d^3, that of a disc with d^2
std::vector<double> draw_radii(const SizeDistribution& sizes, std::size_t n, Random& random,
                               Space space = Space::three_d);

}  // namespace breccia::packing
