// What a bond carries, stores and has left, as functions of its state alone.
// docs/model.md, "Energy ledger" and "Stress".
#pragma once
#include "kernels/laws/bond_laws.hpp"

namespace breccia {

/// Factors on k_n and k_s, and what they come from.
struct BondSecant {
  bool broken = false, pulled = false;
  double elastic = 0;  ///< m, u - u_p
  double normal = 1;   ///< g of k_n: 0 broken and apart
  double shear = 1;    ///< g of k_s
  double delta_normal = 0, delta_shear = 0;
};

/// Factor on k_n of a pressed bond. (B118)
template <class Law>
inline double pressed_ratio(const Law& law, const BondConstants<double>& bond, const BondHistory<double>& h,
                            double distance, double elastic) {
  if (!unloads_elsewhere(law) || elastic == 0.0) return 1.0;
  return carried_stretch(law, bond, distance - bond.rest_length, h.plastic_stretch) / elastic;
}

/// @param distance  m, between the centres
template <class Law>
inline BondSecant secant_of(const Law& law, const BondConstants<double>& bond, const BondHistory<double>& h,
                            double distance, bool coupled) {
  BondSecant s;
  s.broken = h.damage_normal >= 1.0 || h.damage_shear >= 1.0;
  s.elastic = distance - bond.rest_length - h.plastic_stretch;
  s.pulled = s.elastic > 0.0;
  const double length = strain_length(law.young, bond);
  s.delta_normal = delta_normal(law.failure, length);
  s.delta_shear = delta_shear(law.failure, length);
  if (coupled && s.pulled && (h.damage_normal > 0.0 || h.damage_shear > 0.0)) {
    const auto limits = limits_of(law, bond);
    const double a = bond.stiffness * s.elastic / limits.tension, b = norm(h.shear) / limits.cohesion;
    s.delta_normal = s.delta_shear = (s.delta_normal * a + s.delta_shear * b) / (a + b);
  }
  s.normal = !s.pulled  ? pressed_ratio(law, bond, h, distance, s.elastic)
             : s.broken ? 0.0
                        : softening(h.damage_normal, s.delta_normal);
  s.shear = s.broken ? 1.0 : softening(h.damage_shear, s.delta_shear);
  return s;
}

/// J. Normal: 1/2 k_n g(D_n) u_e^2 pulled, 1/2 k_n u_e^2 pressed, none broken and apart; shear:
/// |F_s|^2/(2 k_s g(D_s)).
template <class Law>
inline double stored_energy(const Law& law, const BondConstants<double>& bond, const BondHistory<double>& h,
                            double distance, bool coupled) {
  if (!(bond.stiffness > 0.0)) return 0.0;
  BondSecant s;
  if (h.damage_normal == 0.0 && h.damage_shear == 0.0)  // most bonds: both factors are 1
    s.elastic = distance - bond.rest_length - h.plastic_stretch;
  else
    s = secant_of(law, bond, h, distance, coupled);
  const double shear2 = dot(h.shear, h.shear);  // of k_s times the secant displacement, or of the friction
  // (B50)
  double normal_part = 0.5 * bond.stiffness * s.normal * s.elastic * s.elastic;
  if (unloads_elsewhere(law) && s.elastic < 0.0)
    normal_part = pressed_energy(law, bond, distance - bond.rest_length, h.plastic_stretch);
  if (!(law.shear_ratio > 0.0)) return normal_part;
  return normal_part + 0.5 * s.shear * shear2 / (law.shear_ratio * bond.stiffness);
}

/// Spring forces that the state stands for, N; damping is not among them.
template <class Law>
inline BondForce<double> force_of_state(const Law& law, const BondConstants<double>& bond,
                                        const BondHistory<double>& h, double distance, bool coupled) {
  const BondSecant s = secant_of(law, bond, h, distance, coupled);
  return {s.normal * bond.stiffness * s.elastic, s.normal, s.shear, s.shear * h.shear};
}

/// How near a bond is to failure: max(F_s/S, u_e/u_nf), 1 once broken (S5.21), with the stretch at
/// which tension has softened to nothing for u_nf.
template <class Law>
inline double failure_state(const Law& law, const BondConstants<double>& bond, const BondHistory<double>& h,
                            double distance, bool coupled) {
  if (!(bond.stiffness > 0.0)) return 0.0;
  const BondSecant s = secant_of(law, bond, h, distance, coupled);
  if (s.broken) return 1.0;
  const auto limits = limits_of(law, bond);
  const double normal = s.normal * bond.stiffness * s.elastic;
  const double strength = larger(0.0, limits.cohesion + law.failure.friction_pressed * larger(-normal, 0.0) -
                                          law.failure.friction_pulled * larger(normal, 0.0));
  const double across = strength > 0.0 ? s.shear * norm(h.shear) / strength : 0.0;
  const double along =
      s.pulled ? bond.stiffness * s.elastic / (limits.tension * (1.0 + s.delta_normal)) : 0.0;
  return smaller(1.0, larger(across, along));
}

}  // namespace breccia
