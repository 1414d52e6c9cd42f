#include "core/law_of_material.hpp"

namespace breccia {

double paper_shear_ratio(double poisson_ratio) { return 0.5 / (1.0 + poisson_ratio); }

double matched_shear_ratio(double poisson_ratio) {
  return (1.0 - 4.0 * poisson_ratio) / (1.0 + poisson_ratio);
}

DempackLaw law_of(const Material& m, double shear_ratio) {
  DempackLaw law;
  law.young = m.young_modulus;
  law.shear_ratio = shear_ratio;
  law.tensile_strength = m.tensile_strength;
  law.shear_strength = m.shear_strength;
  law.friction_static = m.friction_static;
  law.friction_dynamic = m.friction_dynamic;
  law.limit_stress = m.limit_compressive_stress;
  double strain = 0.0, reached = 0.0, slope = m.young_modulus;
  for (std::size_t k = 0; k < 3; ++k) {
    strain += (law.limit_stress[k] - reached) / slope;
    reached = law.limit_stress[k];
    slope = m.young_modulus / m.stiffness_reduction[k];
    law.limit_strain[k] = strain;
    law.slope[k] = slope;
  }
  // delta = 2 E G_I/(sigma_t^2 L) - 1 and 2 k_s G_II/(tau_f^2 A) - 1, with k_s = kappa E A/L (MODEL section
  // 3)
  law.softening_normal = m.damage_normal;
  if (m.fracture_energy_normal) {
    law.softening_normal = -1.0;
    law.softening_normal_length =
        2.0 * m.young_modulus * *m.fracture_energy_normal / (m.tensile_strength * m.tensile_strength);
  }
  law.softening_shear = m.damage_shear;
  if (m.fracture_energy_shear) {
    law.softening_shear = -1.0;
    law.softening_shear_length = 2.0 * shear_ratio * m.young_modulus * *m.fracture_energy_shear /
                                 (m.shear_strength * m.shear_strength);
  }
  return law;
}

}  // namespace breccia
