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
      "stiffness_reduction unloading_modulus yield_stress damage_normal damage_shear fracture_energy_normal "
      "fracture_energy_shear "
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
      Features{.unloading = true},
      Features{.criterion = Criterion::coupled, .unloading = true},
      Features{.unloading = true, .several = true},
      Features{.criterion = Criterion::coupled, .unloading = true, .several = true},
  };

  double young = 0;        ///< Pa; E of the bonds: k_n = E A/L
  double shear_ratio = 0;  ///< kappa = k_s/k_n
  Failure failure;
  bool shear_follows = true;             ///< k_s falls with the tangent of k_n (B107)
  std::array<double, 3> limit_stress{};  ///< Pa, LCS
  std::array<double, 3> limit_strain{};  ///< compressive strain at which each limit is met
  std::array<double, 3> slope{};         ///< Pa, E/YRC beyond each limit
  double unloads = 1;                    ///< k_u/k_n, of a bond that has yielded (B118)
  double yield_stress = 0;  ///< Pa, where plasticity begins; up to it a bond goes back as it came

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
    if (m.unloading_modulus) law.unloads = *m.unloading_modulus / m.young_modulus;
    law.yield_stress = m.yield_stress.value_or(law.limit_stress[0]);
    return law;
  }
  /// Whether a bond unloads on another line than its first.
  bool unloads_elsewhere() const { return unloads != 1.0 || yield_stress > limit_stress[0]; }
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

/// J/m^3, of the envelope up to compressive strain e: its area. (B118)
template <class R>
inline R envelope_energy(const DempackLaw& law, const R& e) {
  const auto part = [&](double slope, double from, double to) {
    const R within = larger(R(0.0), smaller(e, R(to)) - R(from));
    return R(slope) * within * (R(0.5) * within + larger(R(0.0), e - R(to)));
  };
  const auto& [e1, e2, e3] = law.limit_strain;
  const R beyond = larger(R(0.0), e - R(e3));
  return part(law.young, 0.0, e1) + part(law.slope[0], e1, e2) + part(law.slope[1], e2, e3) +
         R(0.5 * law.slope[2]) * beyond * beyond;
}

/// Whether a bond is on the envelope beyond its first limit and has not yielded yet. (B118)
template <class R>
inline auto on_curve(const DempackLaw& law, const BondConstants<R>& bond, const R& u, const R& plastic) {
  return plastic >= R(0.0) && -bond.stiffness * u > R(law.limit_stress[0]) * bond.area;
}

/// m, the stretch at which k_n would carry what the bond carries. (B118)
template <class R>
inline R carried_stretch(const DempackLaw& law, const BondConstants<R>& bond, const R& u, const R& plastic) {
  const R elastic = u - plastic;
  const R back = select(elastic < R(0.0) && plastic < R(0.0), R(law.unloads) * elastic, elastic);
  if (!(law.yield_stress > law.limit_stress[0])) return back;
  const auto curve = on_curve(law, bond, u, plastic);
  if (!any(curve)) return back;
  const R strain = -u / strain_length(law.young, bond);
  return select(curve, -envelope_stress(law, strain) * bond.area / bond.stiffness, back);
}

/// J, that a pressed bond gives back. (B118)
template <class R>
inline R pressed_energy(const DempackLaw& law, const BondConstants<R>& bond, const R& u, const R& plastic) {
  const R carried = carried_stretch(law, bond, u, plastic);
  const R line = R(0.5) * bond.stiffness * carried * (u - plastic);
  if (!(law.yield_stress > law.limit_stress[0])) return line;
  const auto curve = on_curve(law, bond, u, plastic);
  if (!any(curve)) return line;
  const R length = strain_length(law.young, bond);
  return select(curve, bond.area * length * envelope_energy(law, -u / length), line);
}

/// Whether a bond may yield in this step; false only where `yield` would leave it as it is,
/// whatever the last bits say.
/// @param elastic  m, stretch beyond the plastic one; of a bond that goes back as it came
template <class R>
inline auto may_yield(const DempackLaw& law, const BondConstants<R>& bond, const R&, const R& elastic) {
  constexpr double nearly = 1.0 - 1e-4;
  return -bond.stiffness * elastic > R(nearly * law.limit_stress[0]) * bond.area;
}

/// Puts a compressive trial above the envelope back onto it; the plastic stretch takes the rest
/// (P52).
/// @tparam elsewhere  bonds may go back on another line than k_n (B118)
/// @returns false where no bond is beyond its first limit
template <bool elsewhere, class R>
inline bool yield(const DempackLaw& law, const BondConstants<R>& bond, const R& u, R& plastic) {
  R trial = -bond.stiffness * (u - plastic);  // N, positive in compression
  if constexpr (elsewhere) trial = select(plastic < R(0.0), R(law.unloads) * trial, trial);
  const auto above_first = trial > R(law.limit_stress[0]) * bond.area;
  if (!any(above_first)) return false;
  const R strain = -u * bond.stiffness / (R(law.young) * bond.area);  // -u/strain_length
  const R limit = envelope_stress(law, strain) * bond.area;
  auto yields = above_first && trial > limit;
  R back = bond.stiffness;
  if constexpr (elsewhere) {
    yields = yields && limit >= R(law.yield_stress) * bond.area;
    back = back * R(law.unloads);
  }
  plastic = select(yields, u + limit / back, plastic);  // (P52)
  return true;
}

}  // namespace breccia
