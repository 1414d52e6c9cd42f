// What a bond law is made of. A law is a struct of constants with
//   name, takes      its word in a case, and the shared keys of [material] that it uses
//   own              keys that it alone has
//   defaults        what a case with this law gets where it does not say otherwise
//   feature_sets     the scenes that a kernel is built for, from the leanest to the fullest
//   of(material)     its constants from a material
//   young, shear_ratio, failure and, where it has plasticity, shear_follows (B107) and, beside it,
// yield<elsewhere>(law, bond, u, plastic), which brings the plastic stretch up to date and says
// whether any may have yielded, and where a bond may unload on another line than k_n,
// unloads_elsewhere, carried_stretch and pressed_energy (B118); `stiffness_of` and `limits_of` are
// overloaded where k_n is not E A/L or strengths are not stresses. It is registered by its line in
// kernels/laws/bond_laws.hpp.
#pragma once
#include <limits>
#include <string_view>

#include "kernels/laws/failure.hpp"

namespace breccia {

/// A key of [material] that one law alone has; read into Material::own.
struct LawParameter {
  std::string_view key, unit;     ///< unit: SI, "1" for a number
  double low = 0;                 ///< smallest value that makes sense
  std::string_view default_text;  ///< default as one writes it; empty: must be given
  std::string_view meaning;
  bool above = false;  ///< low itself makes no sense
};

/// What a case gets where it does not say otherwise.
struct LawDefault {
  std::string_view key, value;
};

/// k_n, N/m, of a bond with this area and length. (P30)
template <class Law>
inline double stiffness_of(const Law& law, double area, double length) {
  return law.young * area / length;
}

/// Whether bonds unload on another line than k_n. (B118)
template <class Law>
inline bool unloads_elsewhere(const Law& law) {
  if constexpr (requires { law.unloads_elsewhere(); })
    return law.unloads_elsewhere();
  else
    return false;
}

/// Largest stiffness of a bond along its normal, in k_n. (B118)
template <class Law>
inline double stiffest(const Law& law) {
  if constexpr (requires { law.unloads; })
    return larger(1.0, law.unloads);
  else
    return 1.0;
}

/// m, the stretch at which k_n would carry what the bond carries. (B118)
template <class Law, class R>
inline R carried_stretch(const Law&, const BondConstants<R>&, const R& u, const R& plastic) {
  return u - plastic;
}

/// J, that a pressed bond gives back. (B118)
template <class Law, class R>
inline R pressed_energy(const Law&, const BondConstants<R>& bond, const R& u, const R& plastic) {
  return R(0.5) * bond.stiffness * (u - plastic) * (u - plastic);
}

/// Whether intact bonds pass moments: what tears them then is not their pull alone, and no fracture
/// energy follows from their state. (B124)
template <class Law>
constexpr bool passes_moments = requires(Law law) {
  law.moment_factor;
};

/// The law where lengths count in `length` m and forces in `force` N, and areas so that stresses
/// stay in Pa.
template <class Law>
inline Law in_units(Law law, double length, double) {
  law.failure.softening_normal_length /= length;
  law.failure.softening_shear_length /= length;
  return law;
}

/// Largest tension and cohesion of a bond, N: strengths are stresses.
template <class Law, class R>
inline BondLimits<R> limits_of(const Law& law, const BondConstants<R>& bond) {
  return limits_of(law.failure, bond);
}

}  // namespace breccia
