// The largest step for which the central difference scheme is stable. MODEL section 8.
#pragma once
#include "core/bond_table.hpp"
#include "core/particle_table.hpp"

namespace breccia {

/// What the particles can do.
struct Freedom {
  bool rotation = true;
  bool plane = false;           ///< two dimensions: no motion along y, no turn about x and z
  double inertia_factor = 0.4;  ///< I = factor m r^2
};

/// With K and C the stiffness and damping of all bonds, intact and pressed, the scheme (damping forces from
/// velocities half a step old) is stable if and only if the largest eigenvalue of M^-1 (dt^2 K/4 + dt C/2) is
/// at most 1/(1 + alpha): Lanczos iteration over the bonds, less 2 % for its error from below.
/// @param shear_ratio  k_s/k_n
/// @param damping      the larger of the two global damping factors, alpha
/// @returns s
double critical_time_step(const ParticleTable& particles, const BondTable& bonds, double shear_ratio,
                          const Freedom& freedom, double damping, int threads);

/// A proven lower bound on the same limit, particle by particle. With its neighbours fixed, let a_i(dt) be
/// the eigenvalue of particle i. Since |x_j - x_i|^2 <= (1 + t)|x_i|^2 + (1 + 1/t)|x_j|^2 for any t > 0, here
/// t = a_j/a_i bond by bond, no network exceeds the largest a_i + a_j over its bonds.
/// @returns s
double proven_time_step(const ParticleTable& particles, const BondTable& bonds, double shear_ratio,
                        const Freedom& freedom, double damping, int threads);

}  // namespace breccia
