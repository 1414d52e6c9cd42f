// The linear frictional contact of two surfaces that were never bonded: a spring and a dashpot that
// never pull, Coulomb friction by radial return: docs/model.md, "In bonded scenes"; Onate et al.
// 2015, eqs. 30, 36, 45.
#pragma once
#include "kernels/laws/pair_kinematics.hpp"

namespace breccia {

/// Constants of one contact. SI.
struct ContactConstants {
  double stiffness = 0;    ///< N/m, k_n
  double shear_ratio = 0;  ///< k_s/k_n
  double damping = 0;      ///< N s/m
  double friction = 0;     ///< mu_2
};

/// Force on lo, N, and the friction force to remember.
/// @param overlap  m, positive where the surfaces press
inline Vec3 linear_contact_force(const ContactConstants& contact, double overlap, const Pair<double>& pair,
                                 Vec3& shear) {
  const double spring = contact.stiffness * overlap;  // N, positive in compression
  // (S3.17)
  const double limit = contact.friction * spring;
  const double size = norm(shear);
  if (size > limit) shear = (limit / size) * shear;
  // surfaces that just meet (overlap 0, as unbonded overlaps do at the start) are not yet damped
  // (B32)
  const double total = overlap > 0.0 ? larger(0.0, spring - contact.damping * pair.rate) : 0.0;
  return shear - total * pair.normal;
}

}  // namespace breccia
