// The Dempack law of one bond: three-slope plasticity in compression, linear softening in tension and shear
// with secant unloading, Coulomb friction after failure. Onate, Zarate, Miquel, Santasusana et al., "A local
// constitutive model for the discrete element method. Application to geomaterials and concrete", Comput.
// Part. Mech. 2 (2015), eqs. 21-52; every point the paper leaves open as in MODEL sections 3 and 4. Tension
// and elongation are positive.
#pragma once
#include <array>

#include "kernels/bond_kinematics.hpp"
#include "kernels/features.hpp"

namespace breccia {

/// Constants of the law, the same for all bonds of a material. SI.
struct DempackLaw {
  double young = 0;                      ///< Pa; E of the bonds: k_n = E A/L
  double shear_ratio = 0;                ///< kappa = k_s/k_n
  double tensile_strength = 0;           ///< Pa, sigma_t
  double shear_strength = 0;             ///< Pa, tau_f
  double friction_static = 0;            ///< mu_1
  double friction_dynamic = 0;           ///< mu_2
  std::array<double, 3> limit_stress{};  ///< Pa, LCS
  std::array<double, 3> limit_strain{};  ///< compressive strain at which each limit is met
  std::array<double, 3> slope{};         ///< Pa, E/YRC beyond each limit
  /// delta = max(0, softening + softening_length/L): the first alone for a given delta, {-1, 2 E
  /// G/strength^2} for a given fracture energy (MODEL section 3)
  double softening_normal = 0, softening_normal_length = 0;  ///< 1, m
  double softening_shear = 0, softening_shear_length = 0;    ///< 1, m
};

/// What a bond is, fixed when it is made.
template <class R>
struct BondConstants {
  R rest_length;  ///< m, d0
  R area;         ///< m^2
  R stiffness;    ///< N/m, k_n
  R damping;      ///< N s/m, c_n
};

/// What a bond remembers.
template <class R>
struct BondHistory {
  Vec<R> shear;  ///< N, k_s times the secant shear displacement while intact, the friction force once broken
  R plastic_stretch;  ///< m, u_p <= 0
  R damage_normal;    ///< D_n, 1 = broken in tension
  R damage_shear;     ///< D_s, 1 = broken in shear
};

/// Secant stiffness left at damage D: the force falls linearly to zero while the displacement grows by 1 +
/// delta.
template <class R>
inline R softening(const R& damage, const R& delta) {
  return (R(1.0) - damage) / (R(1.0) + delta * damage);
}

/// Damage at a displacement `ratio` times the elastic limit; delta = 0 is brittle.
template <class R>
inline R damage_at(const R& ratio, const R& delta) {
  return select(delta > R(0.0), larger(R(0.0), smaller(R(1.0), (ratio - R(1.0)) / delta)), R(1.0));
}

/// Length that strains refer to, L = E A/k_n: the rest length, or its floor for nested spheres.
template <class R>
inline R strain_length(const DempackLaw& law, const BondConstants<R>& bond) {
  return R(law.young) * bond.area / bond.stiffness;
}

/// A bond without stiffness and area has length 0/0; with the NaN in front, `larger` makes its delta 0.
template <class R>
inline R delta_normal(const DempackLaw& law, const R& length) {
  return larger(R(law.softening_normal) + R(law.softening_normal_length) / length, R(0.0));
}
template <class R>
inline R delta_shear(const DempackLaw& law, const R& length) {
  return larger(R(law.softening_shear) + R(law.softening_shear_length) / length, R(0.0));
}

/// Stress of the loading envelope at compressive strain e, Pa (positive). Onate et al. 2015, figure 7.
template <class R>
inline R envelope_stress(const DempackLaw& law, const R& e) {
  const auto part = [](const R& a, double from, double to) {
    return larger(R(0.0), smaller(a, R(to)) - R(from));
  };
  const auto& [e1, e2, e3] = law.limit_strain;
  return R(law.young) * smaller(e, R(e1)) + R(law.slope[0]) * part(e, e1, e2) +
         R(law.slope[1]) * part(e, e2, e3) + R(law.slope[2]) * larger(R(0.0), e - R(e3));
}

/// Puts a compressive trial above the envelope back onto it; the plastic stretch takes the rest (eqs. 50-52).
template <class R>
inline R plastic_stretch(const DempackLaw& law, const BondConstants<R>& bond, const R& u, const R& before) {
  const R trial = -bond.stiffness * (u - before);  // N, positive in compression
  const auto above_first = trial > R(law.limit_stress[0]) * bond.area;
  if (!any(above_first)) return before;
  const R limit = envelope_stress(law, -u / strain_length(law, bond)) * bond.area;
  return select(above_first && trial > limit, u + limit / bond.stiffness, before);
}

/// Force of the spring along the normal and tangential force on lo, N.
template <class R>
struct BondForce {
  R normal;  ///< tension positive, without damping
  R damper;  ///< factor of the viscous force: 1 pressed, g(D_n) pulled, 0 broken and apart
  Vec<R> shear;
};

/// Elastic bond: no strength, no memory but the shear force.
template <class R>
inline BondForce<R> elastic_force(const BondConstants<R>& bond, const R& elastic_stretch,
                                  const BondHistory<R>& h) {
  return {bond.stiffness * elastic_stretch, R(1.0), h.shear};
}

/// The three criteria. `h.shear` has been carried along and has had this step's k_s du added.
template <Criterion criterion, class R>
inline BondForce<R> breakable_force(const DempackLaw& law, const BondConstants<R>& bond,
                                    const R& elastic_stretch, BondHistory<R>& h) {
  const R zero(0.0), one(1.0);
  R normal = bond.stiffness * elastic_stretch;
  auto broken = h.damage_normal >= one || h.damage_shear >= one;
  const auto pulled = normal > zero;  // never a padding bond, which has no stiffness
  const R limit_tension = R(law.tensile_strength) * bond.area;
  const R limit_cohesion = R(law.shear_strength) * bond.area;
  const bool damaged = any(h.damage_normal > zero || h.damage_shear > zero);
  R g_normal = one, g_shear = one;

  // --- along the bond, and with it the shear of a pulled bond where the two are coupled
  if constexpr (criterion == Criterion::coupled) {
    // a + b = 1 is the elastic limit; one damage D for both, its delta weighed by the two shares
    const auto intact_pull = pulled && !broken;
    const R a = normal / limit_tension;
    const R b = square_root(dot(h.shear, h.shear)) / limit_cohesion;
    if (any(intact_pull) && (damaged || any(intact_pull && a + b > one))) {
      const R length = strain_length(law, bond);
      const R r = a + b;
      const R delta = (delta_normal(law, length) * a + delta_shear(law, length) * b) / r;
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
    const auto over = pulled && !broken && normal > limit_tension;
    if (any(over) || damaged) {
      const R delta = delta_normal(law, strain_length(law, bond));
      const R damage = larger(h.damage_normal, damage_at(normal / limit_tension, delta));
      h.damage_normal = select(over, damage, h.damage_normal);
      broken = broken || h.damage_normal >= one;
      g_normal = select(pulled, softening(h.damage_normal, delta), one);
    }
  }
  normal = g_normal * normal;

  // --- across the bond
  const R pressure = larger(-normal, zero);
  const R friction = R(law.friction_dynamic) * pressure;
  R strength;
  if constexpr (criterion == Criterion::mohr_coulomb)
    strength = larger(zero, limit_cohesion - R(law.friction_static) * normal);
  else
    strength = limit_cohesion + R(law.friction_static) * pressure;

  auto sheared = !broken;
  if constexpr (criterion == Criterion::coupled) sheared = sheared && !pulled;
  const R trial2 = dot(h.shear, h.shear);
  const auto beyond = sheared && trial2 > strength * strength;
  if (any(beyond) || damaged) {
    const R delta = delta_shear(law, strain_length(law, bond));
    const R trial = square_root(trial2);
    const auto grows = beyond && trial > strength * (one + delta * h.damage_shear);
    const R damage = larger(h.damage_shear, damage_at(trial / strength, delta));
    const auto fails = grows && (damage >= one || (one - damage) * strength <= friction);
    if constexpr (criterion != Criterion::coupled)
      g_shear = softening(h.damage_shear, delta);
    else
      g_shear = select(pulled, g_shear, softening(h.damage_shear, delta));
    // the force that a failing bond hands over to friction is the one it carried before this step's damage
    h.shear = select(fails, g_shear * h.shear, h.shear);
    if constexpr (criterion == Criterion::coupled)
      h.damage_normal = select(grows && !fails, damage, h.damage_normal);
    h.damage_shear = select(grows, select(fails, one, damage), h.damage_shear);
    broken = broken || fails;
    const R g_after = softening(h.damage_shear, delta);
    if constexpr (criterion == Criterion::coupled)
      g_shear = select(pulled, g_shear, g_after);
    else
      g_shear = g_after;
  }

  // --- broken: no pull, Coulomb friction
  R damper = g_normal;
  if (any(broken)) {
    const auto apart = broken && pulled;
    normal = select(apart, zero, normal);
    damper = select(apart, zero, damper);
    const R limit = select(pulled, zero, friction);
    const R size2 = dot(h.shear, h.shear);
    const R scale = select(size2 > limit * limit, limit / square_root(size2), one);
    h.shear = select(broken, scale * h.shear, h.shear);
    g_shear = select(broken, one, g_shear);
  }
  return {normal, damper, g_shear * h.shear};
}

/// The whole law: advances the history of a bond and returns the force on lo, N (damping included), given the
/// motion of its ends over the step.
template <Features features, class R>
inline Vec<R> dempack_force(const DempackLaw& law, const BondConstants<R>& bond, const Pair<R>& pair,
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
    f = breakable_force<features.criterion>(law, bond, elastic, h);
  else
    f = elastic_force(bond, elastic, h);

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
