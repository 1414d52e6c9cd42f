// How a bond fails: linear softening in tension and shear with secant unloading, a shear strength
// that grows with pressure, Coulomb friction after failure. Onate, Zarate, Miquel, Santasusana et
// al., "A local constitutive model for the discrete element method. Application to geomaterials and
// concrete", Comput. Part. Mech. 2 (2015), eqs. 21-49; every point that the paper leaves open as in
// docs/model.md, "Tension" and "Dempack law, shear". Tension and elongation are positive.
#pragma once
#include "kernels/laws/bond.hpp"
#include "kernels/laws/features.hpp"
#include "kernels/laws/material.hpp"

namespace breccia {

/// Strengths, frictions and softening, the same for all bonds of a material. SI.
struct Failure {
  double tensile_strength = 0;  ///< Pa, sigma_t
  double shear_strength = 0;    ///< Pa, tau_f
  double friction_pressed = 0;  ///< mu_1: shear strength gained per pressure
  double friction_pulled = 0;   ///< shear strength lost per pull: mu_1 of a Mohr-Coulomb line, else 0
  double friction_dynamic = 0;  ///< mu_2, once broken
  /// delta = max(0, softening + softening_length/L): the first alone for a given delta,
  /// {-1, 2 E G/strength^2} for a given fracture energy (B18)
  double softening_normal = 0, softening_normal_length = 0;  ///< 1, m
  double softening_shear = 0, softening_shear_length = 0;    ///< 1, m
  double takeover = 1;  ///< friction takes over where shear has softened to this part of it: 1, or 0 (B21)
};

/// Limits of a bond whose strengths are stresses. (P42)
template <class R>
inline BondLimits<R> limits_of(const Failure& failure, const BondConstants<R>& bond) {
  return {R(failure.tensile_strength) * bond.strength_area, R(failure.shear_strength) * bond.strength_area};
}

/// @param young, shear_ratio  of the bonds: E in Pa, k_s/k_n
inline Failure failure_of(const Material& m, double young, double shear_ratio) {
  Failure f;
  f.tensile_strength = m.tensile_strength;
  f.shear_strength = m.shear_strength;
  f.friction_pressed = m.friction_static;
  f.friction_pulled = m.criterion == Criterion::mohr_coulomb ? m.friction_static : 0.0;  // (B23)
  f.friction_dynamic = m.friction_dynamic;
  f.takeover = m.softens_to_zero ? 0.0 : 1.0;
  // (B18): delta = 2 E G_I/(sigma_t^2 L) - 1 and 2 k_s G_II/(tau_f^2 A) - 1, k_s = kappa E A/L
  f.softening_normal = m.damage_normal;
  if (m.fracture_energy_normal) {
    f.softening_normal = -1.0;
    f.softening_normal_length =
        2.0 * young * *m.fracture_energy_normal / (m.tensile_strength * m.tensile_strength);
  }
  // (P48): the strain at the strength is sigma_t/E; in shear tau_f/(kappa E)
  if (m.failure_strain_normal)
    f.softening_normal = larger(0.0, *m.failure_strain_normal * young / m.tensile_strength - 1.0);
  f.softening_shear = m.damage_shear;
  if (m.failure_strain_shear)
    f.softening_shear = larger(0.0, *m.failure_strain_shear * shear_ratio * young / m.shear_strength - 1.0);
  if (m.fracture_energy_shear) {
    f.softening_shear = -1.0;
    f.softening_shear_length =
        2.0 * shear_ratio * young * *m.fracture_energy_shear / (m.shear_strength * m.shear_strength);
  }
  return f;
}

/// (P46): secant stiffness left at damage D; the force falls linearly to zero while the
/// displacement grows by 1 + delta.
template <class R>
inline R softening(const R& damage, const R& delta) {
  return (R(1.0) - damage) / (R(1.0) + delta * damage);
}

/// (P49): damage at a displacement `ratio` times the elastic limit; delta = 0 is brittle.
template <class R>
inline R damage_at(const R& ratio, const R& delta) {
  return select(delta > R(0.0), larger(R(0.0), smaller(R(1.0), (ratio - R(1.0)) / delta)), R(1.0));
}

/// A bond without stiffness and area has length 0/0; with the NaN in front, `larger` makes its
/// delta 0.
template <class R>
inline R delta_normal(const Failure& failure, const R& length) {
  return larger(R(failure.softening_normal) + R(failure.softening_normal_length) / length, R(0.0));
}
template <class R>
inline R delta_shear(const Failure& failure, const R& length) {
  return larger(R(failure.softening_shear) + R(failure.softening_shear_length) / length, R(0.0));
}

/// Whether a bond without damage may fail in this step; false only where breakable_force would
/// leave it as it is, whatever the last bits say.
/// @param normal  N, tension positive
/// @param shear2  N^2
template <bool coupled, class R>
inline auto may_fail(const Failure& failure, const BondLimits<R>& limits, const R& normal, const R& shear2) {
  constexpr double nearly = 1.0 - 1e-5;
  // coupled, pulled: a + b > 1 is b > 1 - a (B24)
  const R loses = coupled ? R(limits.cohesion / limits.tension) : R(failure.friction_pulled);
  const R strength = limits.cohesion - select(normal < R(0.0), R(failure.friction_pressed), loses) * normal;
  return normal > limits.tension || !(strength >= R(0.0)) ||
         shear2 > R(nearly * nearly) * strength * strength;
}

/// Tension, shear and friction of one bond. `h.shear` has been carried along and has had this
/// step's k_s du added.
/// @param young  Pa; with the area it gives the length that softening refers to
template <bool coupled, class R>
inline BondForce<R> breakable_force(const Failure& failure, double young, const BondLimits<R>& limits,
                                    const BondConstants<R>& bond, const R& elastic_stretch,
                                    BondHistory<R>& h) {
  const R zero(0.0), one(1.0);
  R normal = bond.stiffness * elastic_stretch;
  auto broken = h.damage_normal >= one || h.damage_shear >= one;
  const auto pulled = normal > zero;  // never a padding bond, which has no stiffness
  R g_normal = one, g_shear = one;
  // a given delta is the same for all bonds and needs no length
  const auto delta_along = [&] {
    return failure.softening_normal_length == 0.0 ? R(larger(failure.softening_normal, 0.0))
                                                  : delta_normal(failure, strain_length(young, bond));
  };
  const auto delta_across = [&] {
    return failure.softening_shear_length == 0.0 ? R(larger(failure.softening_shear, 0.0))
                                                 : delta_shear(failure, strain_length(young, bond));
  };

  // --- along the bond, and with it the shear of a pulled bond where the two are coupled
  if constexpr (coupled) {
    // a + b = 1 is the elastic limit; one damage D for both, its delta weighed by the two shares
    const auto intact_pull = pulled && !broken;
    const R a = normal / limits.tension;
    const R b = square_root(dot(h.shear, h.shear)) / limits.cohesion;
    const R r = a + b;  // (B24)
    if (any(intact_pull && (r > one || h.damage_normal > zero || h.damage_shear > zero))) {
      const R delta = (delta_along() * a + delta_across() * b) / r;  // (B24)
      const auto grows = intact_pull && r > one + delta * h.damage_normal;
      const R damage = select(grows, larger(h.damage_normal, damage_at(r, delta)), h.damage_normal);
      const auto fails = grows && damage >= one;
      const auto by_tension = a >= b;
      const R g = softening(damage, delta);
      h.damage_normal = select(grows && !(fails && !by_tension), damage, h.damage_normal);
      h.damage_shear = select(grows && !(fails && by_tension), damage, h.damage_shear);
      broken = broken || fails;
      g_normal = select(intact_pull, g, g_normal);
      g_shear = select(intact_pull, g, g_shear);
    }
  } else {
    const auto intact_pull = pulled && !broken;
    const auto over = intact_pull && normal > limits.tension;  // (P41)
    if (any(over || (intact_pull && h.damage_normal > zero))) {
      const R delta = delta_along();
      if (any(over)) {
        const R damage = larger(h.damage_normal, damage_at(normal / limits.tension, delta));
        h.damage_normal = select(over, damage, h.damage_normal);
        broken = broken || h.damage_normal >= one;
      }
      g_normal = select(intact_pull, softening(h.damage_normal, delta), one);  // (P46)
    }
  }
  normal = g_normal * normal;

  // --- across the bond
  const R pressure = larger(-normal, zero);
  const R friction = R(failure.friction_dynamic) * pressure;
  const R pull = larger(normal, zero);
  // (P42) (B23)
  const R strength = larger(
      zero, limits.cohesion + R(failure.friction_pressed) * pressure - R(failure.friction_pulled) * pull);

  auto sheared = !broken;
  if constexpr (coupled) sheared = sheared && !pulled;
  const R trial2 = dot(h.shear, h.shear);
  const auto beyond = sheared && trial2 > strength * strength;
  if (any(beyond || (sheared && h.damage_shear > zero))) {
    const R delta = delta_across();
    const auto secant = [&] {
      const R g = softening(h.damage_shear, delta);
      if constexpr (coupled)
        return select(pulled, g_shear, g);
      else
        return g;
    };
    g_shear = secant();
    if (any(beyond)) {
      const R trial = square_root(trial2);
      const auto grows = beyond && trial > strength * (one + delta * h.damage_shear);  // (B21)
      const R damage = larger(h.damage_shear, damage_at(trial / strength, delta));
      const auto fails =
          grows && (damage >= one || (one - damage) * strength <= R(failure.takeover) * friction);
      // the force that a failing bond hands over to friction is the one it carried before this
      // step's damage
      h.shear = select(fails, g_shear * h.shear, h.shear);  // (B21)
      if constexpr (coupled) h.damage_normal = select(grows && !fails, damage, h.damage_normal);
      h.damage_shear = select(grows, select(fails, one, damage), h.damage_shear);
      broken = broken || fails;
      g_shear = secant();
    }
  }

  // --- broken: no pull, Coulomb friction
  R damper = g_normal;
  if (any(broken)) {
    const auto apart = broken && pulled;
    normal = select(apart, zero, normal);  // (B22)
    damper = select(apart, zero, damper);
    const R limit = select(pulled, zero, friction);
    const R size2 = dot(h.shear, h.shear);
    const auto slides = broken && size2 > limit * limit;
    // (P45)
    if (any(slides)) h.shear = select(slides, (limit / square_root(size2)) * h.shear, h.shear);
    g_shear = select(broken, one, g_shear);
  }
  return {normal, damper, g_shear, g_shear * h.shear};  // (P37)
}

}  // namespace breccia
