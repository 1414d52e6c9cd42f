// What one bond is and remembers, whatever its law.
#pragma once
#include "kernels/math/lanes.hpp"

namespace breccia {

/// What a bond is, fixed when it is made.
template <class R>
struct BondConstants {
  R rest_length;    ///< m, d0
  R area;           ///< m^2, that the stiffness stands on
  R strength_area;  ///< m^2, that the strengths stand on
  R stiffness;      ///< N/m, k_n
  R damping;        ///< N s/m, c_n
};

/// What a bond remembers.
template <class R>
struct BondHistory {
  Vec<R> shear;  ///< N, k_s times the secant shear displacement while intact, the friction force once broken
  R plastic_stretch;  ///< m, u_p <= 0
  R damage_normal;    ///< D_n, 1 = broken in tension
  R damage_shear;     ///< D_s, 1 = broken in shear
};

/// Force of the spring along the normal and tangential force on lo, N.
template <class R>
struct BondForce {
  R normal;        ///< tension positive, without damping
  R damper;        ///< factor of the viscous force: 1 pressed, g(D_n) pulled, 0 broken and apart
  R shear_factor;  ///< g of k_s: the tangential force over BondHistory::shear; 1 once broken
  Vec<R> shear;
};

/// Largest tension and cohesion of one bond, N.
template <class R>
struct BondLimits {
  R tension, cohesion;
};

/// Length that strains refer to, L = E A/k_n: the rest length, or its floor for nested spheres.
template <class R>
inline R strain_length(double young, const BondConstants<R>& bond) {
  return R(young) * bond.area / bond.stiffness;
}

}  // namespace breccia
