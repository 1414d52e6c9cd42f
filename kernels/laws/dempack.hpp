// The Dempack law: three-slope plasticity in compression; tension, shear and friction as in
// failure.hpp. Onate, Zarate, Miquel, Santasusana et al., "A local constitutive model for the
// discrete element method. Application to geomaterials and concrete", Comput. Part. Mech. 2 (2015),
// eqs. 21-53; docs/model.md, "Dempack law, normal direction".
#pragma once
#include <array>

#include "kernels/laws/bond_law.hpp"

namespace breccia {

struct DempackLaw {
  static constexpr std::string_view name = "dempack";
  static constexpr std::string_view takes =
      "friction_static friction_dynamic rolling_friction tensile_strength shear_strength "
      "limit_compressive_stress "
      "stiffness_reduction damage_normal damage_shear fracture_energy_normal fracture_energy_shear "
      "failure_strain_normal failure_strain_shear shear_residual criterion "
      "limits shear_under_yield";
  static constexpr std::array<LawParameter, 0> own{};
  static constexpr std::array<LawDefault, 0> defaults{};
  static constexpr std::array feature_sets{
      Features{.plasticity = false, .breakage = false},
      Features{.plasticity = false},
      Features{.rotation = false},  // before the next: a scene runs the first set that covers it
      Features{},
      Features{.criterion = Criterion::coupled},
  };

  double young = 0;        ///< Pa; E of the bonds: k_n = E A/L
  double shear_ratio = 0;  ///< kappa = k_s/k_n
  Failure failure;
  bool shear_follows = true;             ///< k_s falls with the tangent of k_n (B107)
  std::array<double, 3> limit_stress{};  ///< Pa, LCS
  std::array<double, 3> limit_strain{};  ///< compressive strain at which each limit is met
  std::array<double, 3> slope{};         ///< Pa, E/YRC beyond each limit

  static DempackLaw of(const Material& m, double shear_ratio) {
    DempackLaw law;
    law.young = m.young_modulus;
    law.shear_ratio = shear_ratio;
    law.failure = failure_of(m, law.young, shear_ratio);
    law.shear_follows = m.shear_under_yield == ShearUnderYield::tangent;
    law.limit_stress = m.limit_compressive_stress;
    double strain = 0.0, reached = 0.0, slope = m.young_modulus;
    for (std::size_t k = 0; k < 3; ++k) {
      strain += (law.limit_stress[k] - reached) / slope;  // (B17)
      reached = law.limit_stress[k];
      slope = m.young_modulus / m.stiffness_reduction[k];  // (P53)
      law.limit_strain[k] = strain;
      law.slope[k] = slope;
    }
    return law;
  }
  void never_yield() { limit_stress.fill(std::numeric_limits<double>::infinity()); }
};

/// Stress of the loading envelope at compressive strain e, Pa (positive). (B17)
template <class R>
inline R envelope_stress(const DempackLaw& law, const R& e) {
  const auto part = [](const R& a, double from, double to) {
    return larger(R(0.0), smaller(a, R(to)) - R(from));
  };
  const auto& [e1, e2, e3] = law.limit_strain;
  return R(law.young) * smaller(e, R(e1)) + R(law.slope[0]) * part(e, e1, e2) +
         R(law.slope[1]) * part(e, e2, e3) + R(law.slope[2]) * larger(R(0.0), e - R(e3));
}

/// Puts a compressive trial above the envelope back onto it; the plastic stretch takes the rest
/// (P52).
/// @returns false where no bond is beyond its first limit
template <class R>
inline bool yield(const DempackLaw& law, const BondConstants<R>& bond, const R& u, R& plastic) {
  const R trial = -bond.stiffness * (u - plastic);  // N, positive in compression
  const auto above_first = trial > R(law.limit_stress[0]) * bond.area;
  if (!any(above_first)) return false;
  const R strain = -u * bond.stiffness / (R(law.young) * bond.area);  // -u/strain_length
  const R limit = envelope_stress(law, strain) * bond.area;
  plastic = select(above_first && trial > limit, u + limit / bond.stiffness, plastic);  // (P52)
  return true;
}

}  // namespace breccia
