// Where the work goes that a bond takes up in a step and does not store: docs/model.md, "Energy
// ledger". The scheme changes the kinetic energy by the trapezoid 1/2 (F(n-1) + F(n)).dx of every
// force, exactly; so every loss is booked by the same trapezoid, with the forces that the step
// before ended with.
#pragma once
#include "kernels/laws/bond_force.hpp"

namespace breccia {

/// J. The energy that a given damage of the normal direction has cost is a function of the state
/// (damage_energy) and is not among them, but for the coupled criterion.
template <class R>
struct BondLosses {
  R plastic{}, viscous{};
  R damage{};    ///< of shear; coupled: of both directions
  R friction{};  ///< on the Coulomb line, once broken
  R failure{};   ///< what a bond still stored in the branch it lost when it broke
};

/// The forces that a bond ended the step before with.
template <class R>
struct LastForces {
  R spring;        ///< N, tension positive
  R viscous;       ///< N, tension positive, as it was applied
  R shear_factor;  ///< g of k_s
};

/// (B52): J, that the damage of the normal direction has cost:
/// D_n 1/2 sigma_t A u_l (1 + delta_n), u_l the stretch at which softening begins.
/// @param tension  N, largest
template <class R>
inline R damage_energy(const R& damage, const R& tension, const R& stiffness, const R& delta) {
  return R(0.5) * damage * (R(1.0) + delta) * tension * tension / stiffness;
}

/// Of a bond without damage the forces follow from where it was.
/// @param stretch  m, elongation of the step since
/// @param before   the history as it was then
template <Features features, class Law, class R>
inline LastForces<R> forces_before(const Law& law, const BondConstants<R>& bond, const BondStrain<R>& strain,
                                   const R& stretch, const BondHistory<R>& before, const R& viscous) {
  const R u = strain.stretch - stretch;
  R elastic = u;
  if constexpr (features.plasticity) {
    elastic -= before.plastic_stretch;
    if constexpr (features.unloading)
      elastic = carried_stretch(law, bond, u, before.plastic_stretch);  // (B118)
  }
  return {bond.stiffness * elastic, viscous, R(1.0)};
}

/// J, that the spring along a bond stores, given the force that it has, N.
template <Features features, class Law, class R>
inline R stored_along(const Law& law, const BondConstants<R>& bond, const R& u, const BondHistory<R>& h,
                      const R& spring) {
  R elastic = u;
  if constexpr (features.plasticity) {
    elastic -= h.plastic_stretch;
    if constexpr (features.unloading)  // (B118)
      return select(elastic < R(0.0), pressed_energy(law, bond, u, h.plastic_stretch),
                    R(0.5) * spring * elastic);
  }
  return R(0.5) * spring * elastic;
}

/// @param stretch  m, elongation of the step
/// @param before   the history as it came into the step; h: as it left
/// @param last     brought up to this step's end
template <Features features, class Law, class R>
inline BondLosses<R> losses_of_step(const Law& law, const BondConstants<R>& bond, const BondStrain<R>& strain,
                                    const R& stretch, const BondHistory<R>& before, const BondHistory<R>& h,
                                    const BondAction<R>& action, LastForces<R>& last) {
  const R half(0.5), zero(0.0), one(1.0);
  BondLosses<R> loss;
  const R mean_spring = half * (last.spring + action.spring);
  const R viscous = action.along - action.spring;
  loss.viscous = half * (last.viscous + viscous) * stretch;  // (B55)

  const R k_s = R(law.shear_ratio) * bond.stiffness;
  const R compliance = select(k_s > zero, half / k_s, zero);  // none of padding
  const R shear_work = half * dot(last.shear_factor * action.rotated + action.shear, strain.slip);
  // as a product of sum and difference: in floats the difference of two stored energies is noise
  const R shear_kept =
      compliance * ((action.shear_factor - last.shear_factor) * dot(h.shear, h.shear) +
                    last.shear_factor * dot(h.shear - action.rotated, h.shear + action.rotated));
  R shear_loss = shear_work - shear_kept;  // (B53)
  R in_shear(0.0);                         // J, taken up by slip that is plastic
  if constexpr (features.plasticity) {
    loss.plastic = mean_spring * (h.plastic_stretch - before.plastic_stretch);  // (B51)
    if constexpr (features.unloading) {                                         // (B118)
      const R u = strain.stretch;
      const R kept = stored_along<features>(law, bond, u, h, action.spring) -
                     stored_along<features>(law, bond, u - stretch, before, last.spring);
      auto undamaged = u - h.plastic_stretch < zero || u - stretch - before.plastic_stretch < zero;
      if constexpr (features.breakage) undamaged = undamaged && h.damage_normal == before.damage_normal;
      loss.plastic = select(undamaged, mean_spring * stretch - kept, loss.plastic);
    }
    if (action.yields) {
      in_shear = action.yielded * shear_work;  // (B107)
      shear_loss -= in_shear;
    }
  }

  if constexpr (features.breakage) {
    const auto was_broken = before.damage_normal >= one || before.damage_shear >= one;
    const auto breaks = !was_broken && (h.damage_normal >= one || h.damage_shear >= one);
    R normal_loss(0.0);
    const auto coupled_damage = [&] {
      if constexpr (features.criterion == Criterion::coupled) return h.damage_normal != before.damage_normal;
      return breaks;
    }();
    if (any(coupled_damage || breaks)) {
      const R u = strain.stretch;
      normal_loss = mean_spring * stretch - loss.plastic -
                    (stored_along<features>(law, bond, u, h, action.spring) -
                     stored_along<features>(law, bond, u - stretch, before, last.spring));
      if constexpr (features.criterion != Criterion::coupled && !passes_moments<Law>) {
        const R delta = delta_normal(law.failure, strain_length(law.young, bond));
        normal_loss -= damage_energy(h.damage_normal - before.damage_normal, limits_of(law, bond).tension,
                                     bond.stiffness, delta);
      }
      loss.failure = select(breaks, normal_loss + shear_loss, zero);  // (B54)
      if constexpr (features.criterion == Criterion::coupled)
        loss.damage = select(coupled_damage && !breaks, normal_loss, zero);
    }
    loss.friction = select(was_broken, shear_loss, zero);
    loss.damage += select(was_broken || breaks, zero, shear_loss);
  } else {
    loss.damage = shear_loss;  // round-off, and an error of the step where a pair turns fast
  }
  if (action.yields) loss.plastic += in_shear;
  last = {action.spring, viscous, action.shear_factor};
  return loss;
}

}  // namespace breccia
