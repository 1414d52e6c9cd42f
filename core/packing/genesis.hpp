// Discs inflated until the walls feel a wanted pressure: the genesis pressure of Fakhimi &
// Villegas, Rock Mech. Rock Engng 40 (2007) 193-211. The overlaps that it leaves raise friction
// angle and UCS/tensile strength of the bonded assembly. They tune it by the number of discs; here
// the number is given and the radii grow, which differs in scale alone.
#pragma once
#include <functional>
#include <span>

#include "core/packing/region.hpp"

namespace breccia::packing {

/// Mean over the walls of the mean pressure on each, over k_n; contacts as linear springs, k_n in
/// N/m per metre of thickness, with discs and walls alike.
double wall_pressure(const Region& region, std::span<const double> r, std::span<const Vec3> x);

/// Scales all radii by one factor and moves the centres until, in static equilibrium without
/// friction, the wall pressure is `wanted` to 0.2 %. Throws BadInput when it cannot be reached.
/// @param wanted    sigma_0/k_n
/// @param progress  called with the fraction done and the mean overlap over the mean radius
void inflate(const Region& region, double wanted, std::span<double> r, std::span<Vec3> x,
             const std::function<void(double, double)>& progress);

}  // namespace breccia::packing
