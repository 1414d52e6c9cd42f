// Energy stored in a bond, a function of its state alone. MODEL section 9.
#pragma once
#include "kernels/dempack.hpp"

namespace breccia {

/// J. Normal: 1/2 k_n g(D_n) u_e^2 pulled, 1/2 k_n u_e^2 pressed, none broken and apart; shear: |F_s|^2/(2
/// k_s g(D_s)).
/// @param distance  m, between the centres
inline double stored_energy(const DempackLaw& law, const BondConstants<double>& bond,
                            const BondHistory<double>& h, double distance, Criterion criterion) {
  if (!(bond.stiffness > 0.0)) return 0.0;
  const bool broken = h.damage_normal >= 1.0 || h.damage_shear >= 1.0;
  const double elastic = distance - bond.rest_length - h.plastic_stretch;
  const bool pulled = elastic > 0.0, damaged = h.damage_normal > 0.0 || h.damage_shear > 0.0;
  const double shear = norm(h.shear);  // k_s times the secant displacement, or the friction force
  const double length = strain_length(law, bond);
  double delta_n = delta_normal(law, length), delta_s = delta_shear(law, length);
  if (criterion == Criterion::coupled && pulled && damaged) {
    const double a = bond.stiffness * elastic / (law.tensile_strength * bond.area);
    const double b = shear / (law.shear_strength * bond.area);
    delta_n = delta_s = (delta_n * a + delta_s * b) / (a + b);
  }
  const double g_normal = !pulled ? 1.0 : broken ? 0.0 : softening(h.damage_normal, delta_n);
  const double g_shear = broken ? 1.0 : softening(h.damage_shear, delta_s);
  const double normal_part = 0.5 * bond.stiffness * g_normal * elastic * elastic;
  if (!(law.shear_ratio > 0.0)) return normal_part;
  return normal_part + 0.5 * g_shear * shear * shear / (law.shear_ratio * bond.stiffness);
}

}  // namespace breccia
