// The force of one bond: kinematics, the law, damping.
#pragma once
#include "kernels/bond_kinematics.hpp"
#include "kernels/bond_law.hpp"

namespace breccia {

/// Advances the history of a bond and returns the force on lo, N (damping included), given the motion of its
/// ends over the step.
template <Features features, class Law, class R>
inline Vec<R> bond_force(const Law& law, const BondConstants<R>& bond, const Pair<R>& pair,
                         BondHistory<R>& h) {
  const R u = pair.distance - bond.rest_length;
  h.shear = carry<features.rotation>(h.shear, pair) + (R(law.shear_ratio) * bond.stiffness) * pair.slip;
  R elastic = u;
  if constexpr (features.plasticity) {
    h.plastic_stretch = plastic_stretch(law, bond, u, h.plastic_stretch);
    elastic = u - h.plastic_stretch;
  }
  BondForce<R> f;
  if constexpr (features.breakage)
    f = breakable_force<features.criterion == Criterion::coupled>(law.failure, law.young,
                                                                  limits_of(law, bond), bond, elastic, h);
  else
    f = {bond.stiffness * elastic, R(1.0), h.shear};

  R total = f.normal;
  if constexpr (features.contact_damping) {
    total += f.damper * bond.damping * pair.rate;
    if constexpr (features.breakage) {  // a broken bond never pulls (MODEL section 2)
      const auto broken = h.damage_normal >= R(1.0) || h.damage_shear >= R(1.0);
      total = select(broken && total > R(0.0), R(0.0), total);
    }
  }
  return total * pair.normal + f.shear;
}

}  // namespace breccia
