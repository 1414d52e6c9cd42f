// What a specimen is made of, as an engineer states it. SI.
#pragma once
#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "kernels/laws/features.hpp"

namespace breccia {

/// What the tangential stiffness of a bond does while its compression yields: it falls as the
/// normal tangent does, or stays elastic. (B107)
enum class ShearUnderYield : unsigned char { tangent, elastic };

/// What limit_compressive_stress is a stress of: a bond, or a specimen under even pressure. (B109)
enum class LimitStress : unsigned char { bond, macroscopic };

/// How surfaces press that were never bonded.
enum class ContactLaw : unsigned char { linear, hertz_mindlin };

/// Parameters of a bond law for one confinement; their names are those of Onate et al. 2015, tables
/// 2 to 6. Which of them a law takes, its header says.
struct Material {
  double density = 0;           ///< kg/m^3, of the spheres
  double young_modulus = 0;     ///< Pa, of the specimen
  double poisson_ratio = 0;     ///< 1
  double friction_static = 0;   ///< mu_1: how much shear strength grows with pressure on the bond
  double friction_dynamic = 0;  ///< mu_2: Coulomb friction of broken bonds and contacts
  double rolling_friction = 0;  ///< mu_r, of broken bonds and contacts
  double tensile_strength = 0;  ///< Pa, sigma_t
  double shear_strength = 0;    ///< Pa, tau_f
  std::array<double, 3> limit_compressive_stress{};          ///< Pa, LCS 1, 2, 3, rising
  std::array<double, 3> stiffness_reduction{1.0, 1.0, 1.0};  ///< YRC 1, 2, 3: slope beyond a limit is E/YRC
  std::optional<double> unloading_modulus;  ///< Pa, E of a bond that has yielded, on its way back (B118)
  std::optional<double> yield_stress;       ///< Pa, LCS 1 or above, where plasticity begins (B118)
  double damage_normal = 0;  ///< delta_n: length of the softening branch over the elastic one (P47)
  double damage_shear = 0;   ///< delta_s
  std::optional<double> fracture_energy_normal;  ///< J/m^2, G_I: instead of damage_normal
  std::optional<double> fracture_energy_shear;   ///< J/m^2, G_II: instead of damage_shear
  std::optional<double> failure_strain_normal;   ///< eps_f, where tension has softened to nothing (P48)
  std::optional<double> failure_strain_shear;    ///< gamma_f, the same of shear
  bool softens_to_zero =
      false;  ///< shear softens to nothing before friction takes over (P46), not to the friction
  std::string law = "dempack";
  Criterion criterion = Criterion::uncoupled;
  ShearUnderYield shear_under_yield = ShearUnderYield::tangent;
  LimitStress limits = LimitStress::bond;
  ContactLaw contact_law = ContactLaw::linear;
  std::map<std::string, double, std::less<>> own;  ///< parameters that one law alone has, by their keys
};

}  // namespace breccia
