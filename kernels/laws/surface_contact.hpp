// The frictional contact of two surfaces that were never bonded, in a bonded scene: a spring and a
// dashpot that never pull, Coulomb friction by radial return: docs/model.md, "In bonded scenes";
// Onate et al. 2015, eqs. 30, 36, 45. The spring is linear, or Hertz's with Mindlin's across it.
#pragma once
#include "kernels/laws/pair_kinematics.hpp"

namespace breccia {

/// Constants of one contact. SI.
struct ContactConstants {
  double stiffness = 0;    ///< N/m, k_n; of Hertz's the largest that the step counts with
  double shear_ratio = 0;  ///< k_s/k_n
  double damping = 0;      ///< N s/m
  double friction = 0;     ///< mu_2
  double hertz_normal = 0, hertz_tangential = 0;  ///< N/m^1.5; 0: linear
};

/// Of a pair of equal materials, N/m^1.5: F = normal u^(3/2), k_t = tangential u^(1/2).
struct HertzConstants {
  double normal = 0, tangential = 0;
};

/// (B34) (B35) of two bodies of one E and nu.
/// @param radius  m, r_i r_j/(r_i + r_j)
inline HertzConstants hertz_constants(double young, double poisson, double radius) {
  const double root = std::sqrt(radius);
  return {2.0 / 3.0 * young / (1.0 - poisson * poisson) * root,
          2.0 * young / ((2.0 - poisson) * (1.0 + poisson)) * root};
}

/// Of the overlap alone.
struct SurfaceSpring {
  double force = 0;    ///< N, positive in compression
  double across = 0;   ///< N/m, tangential stiffness
  double damping = 0;  ///< N s/m
  double stored = 0;   ///< J, along the normal
};

/// @param overlap  m, 0 or more
inline SurfaceSpring surface_spring(const ContactConstants& c, double overlap) {
  if (!(c.hertz_normal > 0.0)) {
    const double force = c.stiffness * overlap;
    return {force, c.shear_ratio * c.stiffness, c.damping, 0.5 * force * overlap};
  }
  const double root = std::sqrt(overlap), force = c.hertz_normal * overlap * root;  // (B34)
  const double slope = 1.5 * c.hertz_normal * root;
  // (B35) (B36)
  return {force, c.hertz_tangential * root, c.damping * std::sqrt(5.0 / 6.0 * slope / c.stiffness),
          0.4 * force * overlap};
}

/// (B35): the friction force gives back less while the overlap shrinks, so that no path gains
/// energy.
inline Vec3 friction_held(const ContactConstants& c, const Vec3& rotated, double overlap, double before) {
  if (!(c.hertz_normal > 0.0) || !(overlap < before)) return rotated;
  return std::sqrt(larger(0.0, overlap) / before) * rotated;
}

/// Force on lo, N, and the friction force to remember.
/// @param overlap  m, positive where the surfaces press
/// @param shear    N, with this step's k_s du
inline Vec3 surface_force(const ContactConstants& contact, double overlap, const Pair<double>& pair,
                          Vec3& shear) {
  const SurfaceSpring spring = surface_spring(contact, larger(0.0, overlap));
  // (S3.17)
  const double limit = contact.friction * spring.force;
  const double size = norm(shear);
  if (size > limit) shear = (limit / size) * shear;
  // surfaces that just meet (overlap 0, as unbonded overlaps do at the start) are not yet damped
  // (B32)
  const double total = overlap > 0.0 ? larger(0.0, spring.force - spring.damping * pair.rate) : 0.0;
  return shear - total * pair.normal;
}

}  // namespace breccia
