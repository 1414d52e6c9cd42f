// The contact bond of discs: a point of glue with stiffnesses and strengths that do not depend on
// the size of the discs; Coulomb friction once it is broken. Fakhimi and Villegas, "Application of
// dimensional analysis in calibration of a discrete element model for rock deformation and
// fracture", Rock Mech. Rock Engng 40 (2007) 193-211; docs/model.md, "contact-bond".
#pragma once
#include <array>

#include "kernels/laws/bond_law.hpp"

namespace breccia {

struct ContactBondLaw {
  static constexpr std::string_view name = "contact-bond";
  static constexpr std::string_view takes = "friction_dynamic rolling_friction";
  static constexpr std::array own{
      LawParameter{"normal_stiffness", "N/m", 0.0, "", "k_n of a bond; of discs per metre of their thickness",
                   true},
      LawParameter{"shear_stiffness", "N/m", 0.0, "", "k_s of a bond"},
      LawParameter{"normal_strength", "N", 0.0, "", "n_b: tension that breaks a bond", true},
      LawParameter{"bond_shear_strength", "N", 0.0, "", "s_b: shear force that breaks a bond", true},
  };
  static constexpr std::array defaults{LawDefault{"bonds.alpha", "1"}};
  static constexpr std::array feature_sets{Features{.plasticity = false},
                                           Features{.plasticity = false, .several = true}};

  double young = 0;        ///< Pa, only for what needs a wave speed
  double shear_ratio = 0;  ///< k_s/k_n
  Failure failure;
  double stiffness = 0;                            ///< N/m
  double normal_strength = 0, shear_strength = 0;  ///< N

  static ContactBondLaw of(const Material& m, double) {
    ContactBondLaw law;
    law.young = m.young_modulus;
    law.stiffness = m.own.at("normal_stiffness");
    law.shear_ratio = m.own.at("shear_stiffness") / law.stiffness;
    law.normal_strength = m.own.at("normal_strength");
    law.shear_strength = m.own.at("bond_shear_strength");
    law.failure.friction_dynamic = m.friction_dynamic;
    return law;
  }
  void never_yield() {}
};

// (B28)
inline double stiffness_of(const ContactBondLaw& law, double, double) { return law.stiffness; }

inline ContactBondLaw in_units(ContactBondLaw law, double, double force) {
  law.normal_strength /= force, law.shear_strength /= force;
  return law;
}

template <class R>
inline BondLimits<R> limits_of(const ContactBondLaw& law, const BondConstants<R>&) {
  return {R(law.normal_strength), R(law.shear_strength)};  // (B28)
}

}  // namespace breccia
