// A bound on the step for which the central difference scheme is proven stable. MODEL section 8.
#pragma once
#include "core/bond_table.hpp"
#include "core/particle_table.hpp"

namespace breccia {

/// With K and C the stiffness and damping of all bonds, intact and pressed, the scheme is stable while the largest
/// eigenvalue of M^-1 (dt^2 K/4 + dt C/2) is at most 1/(1 + alpha). For each particle alone, its neighbours fixed,
/// let a_i(dt) be that eigenvalue. Since |x_j - x_i|^2 <= (1 + t)|x_i|^2 + (1 + 1/t)|x_j|^2 for any t > 0, here
/// t = a_j/a_i bond by bond, no network exceeds the largest a_i + a_j over its bonds.
/// @param damping  the larger of the two global damping factors
/// @returns s; at most the exact limit, and not below it by more than a factor of two
double stable_time_step(const ParticleTable& particles, const BondTable& bonds, double shear_ratio, double damping,
                        int threads);

}  // namespace breccia
