// The force of one bond: kinematics, the law, damping.
#pragma once
#include "kernels/laws/bond_law.hpp"
#include "kernels/laws/pair_kinematics.hpp"

namespace breccia {

/// What a bond does at the end of a step.
template <class R>
struct BondAction {
  R spring;             ///< N, along the normal, tension positive: the law's force
  R along;              ///< N, the same with the dashpot
  R shear_factor;       ///< g of k_s
  Vec<R> shear;         ///< N, on lo
  Vec<R> rotated;       ///< N, the history of shear as it came into the step, turned with the pair
  bool yields = false;  ///< some of this step's slip may be plastic:
  R yielded{};          ///< this part of it
};

/// How a bond was strained in a step, whatever its ends look like.
template <class R>
struct BondStrain {
  R stretch;     ///< m, u: how much longer it is than at rest (P26)
  R elastic;     ///< m, the same beyond the plastic stretch that it came with
  R stretching;  ///< m, elongation of this step, to first order
  R rate;        ///< m/s, of elongation
  Vec<R> slip;   ///< m, tangential displacement of this step
};

/// (B107): the part of a step's slip that is plastic while the compression of a bond yields, so
/// that the tangential stiffness falls as the normal tangent does: |du_p|/|du|. Slip that takes
/// shear back gains no more than the compression loses, so that no closed path yields energy.
/// @param flow     m, |du_p| of this step
/// @param pressed  N, on the bond, mean of the step
/// @param shear    N, the history, turned with the pair
template <class R>
inline R plastic_part_of_slip(const BondStrain<R>& strain, const R& flow, const R& pressed,
                              const Vec<R>& shear) {
  constexpr double tiny = 1e-37;  // a float has it too
  const R follows = flow / (larger(strain.stretching, -strain.stretching) + R(tiny));
  const R taken_back = larger(R(0.0), -dot(shear, strain.slip));
  return smaller(smaller(R(1.0), follows), pressed * flow / (taken_back + R(tiny)));
}

/// N, on lo.
template <class R>
inline Vec<R> force_on_lo(const BondAction<R>& action, const Pair<R>& pair) {
  return action.along * pair.normal + action.shear;  // (P18)
}

/// The law: advances the history of a bond that was strained so.
/// @param rotated  N, the history of shear, turned with the pair
/// @param h        h.shear: the trial, rotated and with k_s du added (B20) (P37)
template <Features features, class Law, class R>
inline BondAction<R> strained(const Law& law, const BondConstants<R>& bond, const BondStrain<R>& strain,
                              const Vec<R>& rotated, BondHistory<R>& h) {
  const R u = strain.stretch;
  BondAction<R> action;
  R elastic = strain.elastic;
  if constexpr (features.plasticity) {
    const R before = h.plastic_stretch;
    const bool may_yield = yield<features.unloading>(law, bond, u, h.plastic_stretch);
    if (may_yield) elastic = select(h.plastic_stretch != before, u - h.plastic_stretch, elastic);
    R elastic_growth = strain.stretching + (before - h.plastic_stretch);
    if constexpr (features.unloading) {  // (B118)
      const R was = carried_stretch(law, bond, u - strain.stretching, before);
      elastic = carried_stretch(law, bond, u, h.plastic_stretch);
      elastic_growth = elastic - was;
    }
    if (may_yield && law.shear_follows) {
      const auto yields = h.plastic_stretch < before;
      const R flow = before - h.plastic_stretch;
      const R pressed = bond.stiffness * larger(R(0.5) * elastic_growth - elastic, R(0.0));
      const R part = plastic_part_of_slip(strain, flow, pressed, rotated);
      action.yields = true;
      action.yielded = select(yields, part, R(0.0));
      h.shear -= (action.yielded * (R(law.shear_ratio) * bond.stiffness)) * strain.slip;  // (B107)
    }
  }
  BondForce<R> f;
  if constexpr (features.breakage)
    f = breakable_force<features.criterion == Criterion::coupled>(law.failure, law.young,
                                                                  limits_of(law, bond), bond, elastic, h);
  else
    f = {bond.stiffness * elastic, R(1.0), R(1.0), h.shear};

  R total = f.normal;
  if constexpr (features.contact_damping) {
    // (P29)
    total += f.damper * bond.damping * strain.rate;
    if constexpr (features.breakage) {  // a broken bond never pulls (B12)
      const auto broken = h.damage_normal >= R(1.0) || h.damage_shear >= R(1.0);
      total = select(broken && total > R(0.0), R(0.0), total);
    }
  }
  action.spring = f.normal, action.along = total, action.shear_factor = f.shear_factor;
  action.shear = f.shear, action.rotated = rotated;
  return action;
}

/// @param plastic  m, the plastic stretch that the bond comes with
template <bool plasticity, class R>
inline BondStrain<R> strain_of(const BondConstants<R>& bond, const Pair<R>& pair, const R& plastic) {
  const R u = pair.distance - bond.rest_length;
  R elastic = u;
  if constexpr (plasticity) elastic = u - plastic;
  return {u, elastic, pair.stretching, pair.rate, pair.slip};
}

/// Advances the history of a bond, given the motion of its ends over the step.
template <Features features, class Law, class R>
inline BondAction<R> bond_action(const Law& law, const BondConstants<R>& bond, const Pair<R>& pair,
                                 BondHistory<R>& h) {
  const Vec<R> rotated = rotate_with_pair<features.rotation>(h.shear, pair);
  h.shear = rotated + R(law.shear_ratio) * bond.stiffness * pair.slip;
  return strained<features>(law, bond, strain_of<features.plasticity>(bond, pair, h.plastic_stretch), rotated,
                            h);
}

/// The force alone.
template <Features features, class Law, class R>
inline Vec<R> bond_force(const Law& law, const BondConstants<R>& bond, const Pair<R>& pair,
                         BondHistory<R>& h) {
  return force_on_lo(bond_action<features>(law, bond, pair, h), pair);
}

}  // namespace breccia
