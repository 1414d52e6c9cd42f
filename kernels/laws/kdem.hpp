// The elastic-brittle law of KDEM: no plasticity, no softening; the stiffness stands on the areas
// of virtual polyhedra, with factors alpha on k_n and beta on k_s. Santasusana, "Kratos DEM, a
// parallel code for concrete testing simulations using the discrete element method", MSc thesis,
// eqs. 4.33, 4.34 (without the second pi) and 5.7; docs/model.md, "kdem".
#pragma once
#include <array>

#include "kernels/laws/bond_law.hpp"

namespace breccia {

struct KdemLaw {
  static constexpr std::string_view name = "kdem";
  static constexpr std::string_view takes =
      "friction_static friction_dynamic rolling_friction tensile_strength shear_strength criterion";
  static constexpr std::array own{
      LawParameter{"normal_factor", "1", 0.0, "1", "alpha of the thesis' eq. 5.7, on k_n", true},
      LawParameter{"shear_factor", "1", 0.0, "1", "beta of the thesis' eq. 5.7, on k_s"},
  };
  static constexpr std::array defaults{LawDefault{"bonds.area", "polyhedron"},
                                       LawDefault{"bonds.alpha", "1"}};
  static constexpr std::array feature_sets{Features{.plasticity = false},
                                           Features{.plasticity = false, .several = true}};

  double young = 0;        ///< Pa, alpha E
  double shear_ratio = 0;  ///< beta/alpha/(2(1 + nu))
  Failure failure;

  static KdemLaw of(const Material& m, double shear_ratio) {
    KdemLaw law;
    const double alpha = m.own.at("normal_factor"), beta = m.own.at("shear_factor");
    law.young = alpha * m.young_modulus;  // (S5.7)
    // (S5.7)
    law.shear_ratio = beta / alpha * shear_ratio;
    law.failure = failure_of(m, law.young, law.shear_ratio);
    return law;
  }
  void never_yield() {}
};

}  // namespace breccia
