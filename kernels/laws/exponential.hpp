// Concrete under high confinement: linear up to a compressive strain, then a secant stiffness that
// falls and, as pores close, rises exponentially; Mohr-Coulomb in shear. Tran, Donze and Marin,
// "Discrete element modelling of concrete under high-triaxial loading", Cem. Concr. Compos. 33
// (2011), as in the Arrufat thesis, section 4.3; docs/model.md, "Exponential".
#pragma once
#include <array>

#include "kernels/laws/bond_law.hpp"

namespace breccia {

struct ExponentialLaw {
  static constexpr std::string_view name = "exponential";
  static constexpr std::string_view takes =
      "friction_static friction_dynamic rolling_friction tensile_strength shear_strength damage_normal "
      "damage_shear "
      "shear_under_yield";
  static constexpr std::array own{
      LawParameter{"elastic_strain_limit", "1", 0.0, "0.002",
                   "e_max: compressive strain where hardening begins"},
      LawParameter{"hardening_factor", "1", 0.0, "0.2", "gamma_1: of the exponential part of K2/k_n"},
      LawParameter{"hardening_rate", "1", 0.0, "16", "gamma_2: growth of K2 with strain"},
      LawParameter{"hardening_floor", "1", 0.0, "0.275", "gamma_3: of the constant part of K2/k_n"},
  };
  static constexpr std::array defaults{LawDefault{"test.hydrostatic_branch", "law"}};
  static constexpr std::array feature_sets{
      Features{.criterion = Criterion::mohr_coulomb},
      Features{.criterion = Criterion::mohr_coulomb, .several = true},
  };

  double young = 0;        ///< Pa
  double shear_ratio = 0;  ///< k_s/k_n
  Failure failure;
  bool shear_follows = true;               ///< k_s falls with the tangent of k_n (B107)
  double strain_limit = 0;                 ///< e_max
  double factor = 0, rate = 0, floor = 0;  ///< gamma_1, gamma_2, gamma_3
  double most = 0;                         ///< gamma_2 (e - e_max) beyond which K2 = k_n

  static ExponentialLaw of(const Material& m, double shear_ratio) {
    ExponentialLaw law;
    law.young = m.young_modulus;
    law.shear_ratio = shear_ratio;
    law.failure = failure_of(m, law.young, shear_ratio);
    law.shear_follows = m.shear_under_yield == ShearUnderYield::tangent;
    law.failure.friction_pulled = m.friction_static;  // (B27): F_n of either sign
    law.strain_limit = m.own.at("elastic_strain_limit");
    law.factor = m.own.at("hardening_factor");
    law.rate = m.own.at("hardening_rate");
    law.floor = m.own.at("hardening_floor");
    law.most = law.floor < 1.0 && law.factor > 0.0 ? std::log((1.0 - law.floor) / law.factor) : 0.0;
    return law;
  }
  void never_yield() { strain_limit = std::numeric_limits<double>::infinity(); }
};

/// (B25): K2/k_n at compressive strain e beyond e_max:
/// min(1, gamma_3 + gamma_1 exp(gamma_2 (e - e_max))).
template <class R>
inline R secant_ratio(const ExponentialLaw& law, const R& e) {
  const R x = smaller(R(law.rate) * (e - R(law.strain_limit)), R(larger(law.most, 0.0)));
  return smaller(R(1.0), R(law.floor) + R(law.factor) * exponential(x));
}

/// Whether a bond may yield in this step; false only where `yield` would leave it as it is,
/// whatever the last bits say.
template <class R>
inline auto may_yield(const ExponentialLaw& law, const BondConstants<R>& bond, const R& u, const R&) {
  constexpr double nearly = 1.0 - 1e-4;
  return -u > R(nearly * law.strain_limit) * strain_length(law.young, bond);
}

/// Puts a compressive trial above the envelope k_n L e_max + K2 L (e - e_max) back onto it. (B26)
template <bool elsewhere, class R>
inline bool yield(const ExponentialLaw& law, const BondConstants<R>& bond, const R& u, R& plastic) {
  const R length = strain_length(law.young, bond);
  const R e = -u / length;
  const auto beyond = e > R(law.strain_limit);
  if (!any(beyond)) return false;
  const R limit =
      bond.stiffness * length * (R(law.strain_limit) + secant_ratio(law, e) * (e - R(law.strain_limit)));
  const R trial = -bond.stiffness * (u - plastic);
  plastic = select(beyond && trial > limit, u + limit / bond.stiffness, plastic);
  return true;
}

}  // namespace breccia
