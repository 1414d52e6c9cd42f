// The parallel bond: cement of a round cross-section that passes forces and moments, and breaks
// where the largest stress in it reaches a strength. Potyondy and Cundall, "A bonded-particle model
// for rock", Int. J. Rock Mech. Min. Sci. 41 (2004), eqs. 12-17; docs/model.md, "Parallel bond".
// Forces are those of any brittle bond; moments are a pass of their own
// (kernels/loops/moment_couple.hpp).
#pragma once
#include <array>
#include <numbers>

#include "kernels/laws/bond_law.hpp"

namespace breccia {

struct ParallelBondLaw {
  static constexpr std::string_view name = "parallel-bond";
  static constexpr std::string_view takes =
      "friction_static friction_dynamic tensile_strength shear_strength";
  static constexpr std::array own{
      LawParameter{"moment_factor", "1", 0.0, "1",
                   "beta: part of the moments' stresses that counts for breaking"},
  };
  static constexpr std::array defaults{LawDefault{"run.precision", "double"}};
  static constexpr std::array feature_sets{Features{.plasticity = false},
                                           Features{.plasticity = false, .several = true}};

  double young = 0;        ///< Pa
  double shear_ratio = 0;  ///< k_s/k_n
  Failure failure;
  double moment_factor = 1;

  static ParallelBondLaw of(const Material& m, double shear_ratio) {
    ParallelBondLaw law;
    law.young = m.young_modulus;
    law.shear_ratio = shear_ratio;
    law.failure = failure_of(m, law.young, shear_ratio);
    law.moment_factor = m.own.at("moment_factor");
    return law;
  }
  void never_yield() {}
};

/// Of a bond against turning of its ends, N m per rad.
struct MomentStiffness {
  double bend = 0, twist = 0;
};

/// Radius of the cement, m; in the plane half its width.
inline double cement_radius(double area, bool plane) {
  return plane ? 0.5 * area : std::sqrt(area / std::numbers::pi);
}

/// (B123): k_n I/A and k_s J/A.
inline MomentStiffness moment_stiffness(double normal, double shear, double area, bool plane) {
  const double r = cement_radius(area, plane), r2 = r * r;
  if (plane) return {normal * r2 / 3.0, 0.0};
  return {normal * r2 / 4.0, shear * r2 / 2.0};
}

/// (B124): N, that moments add to the pull and to the shear which strengths are compared with.
struct MomentForces {
  double pull = 0, shear = 0;
};
inline MomentForces forces_of_moments(double bending, double twisting, double area, bool plane,
                                      double factor) {
  const double r = cement_radius(area, plane);
  if (plane) return {3.0 * factor * bending / r, 0.0};
  return {4.0 * factor * bending / r, 2.0 * factor * twisting / r};
}

}  // namespace breccia
