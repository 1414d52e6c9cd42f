// Radii that follow a size distribution.
#pragma once
#include <vector>

#include "core/base/random.hpp"
#include "core/packing/packing.hpp"

namespace breccia::packing {

/// Throws BadPacking when the law is empty, unordered or impossible.
void check_sizes(const SizeDistribution& sizes);

/// n relative radii, largest first. Stratified: one draw in each of n equal slices of probability,
/// so that a small packing follows the law as closely as a large one.
/// @param space  sieves: the mass of a sphere goes with d^3, that of a disc with d^2
std::vector<double> draw_radii(const SizeDistribution& sizes, std::size_t n, Random& random,
                               Space space = Space::three_d);

/// Sieves: spheres in a cubic metre of solid.
double spheres_per_volume(const SizeDistribution& sizes, Space space);

/// Sieves, without what is finer than a diameter, m: what passes counts from there.
SizeDistribution without_fines(const SizeDistribution& sizes, double finest);

/// Sieves: moves diameters within their classes, all towards the finer or all towards the coarser
/// opening, until the sum of r^3 (discs: of r^2) is `wanted`. Draws miss it by a little.
/// @throws BadPacking  when the classes do not go so far: the spheres are too few
void fit_within_classes(const SizeDistribution& sizes, double wanted, std::vector<double>& radii,
                        Space space);

}  // namespace breccia::packing
