// The contact of two elastic spheres: Hertz along the normal, Mindlin's no-slip stiffness across it
// with Coulomb friction by radial return, viscous damping that gives a coefficient of restitution.
// Johnson, Contact Mechanics (1985), sections 4.2 and 7.2.
#pragma once
#include "kernels/laws/pair_kinematics.hpp"

namespace breccia {

/// Constants of one contact. SI.
struct HertzMindlin {
  double normal = 0;      ///< N/m^1.5: F = normal u^1.5
  double tangential = 0;  ///< N/m^1.5: k_t = tangential u^0.5
  double damping = 0;     ///< kg^0.5: c = damping sqrt(dF/du)
  double friction = 0;    ///< Coulomb
};

/// One body of a contact; a wall has infinite radius and mass.
struct ElasticBody {
  double young = 0, poisson = 0;  ///< Pa, 1
  double curvature = 0;           ///< 1/m: 1/r
  double inverse_mass = 0;        ///< 1/kg
};

/// 4/3 E* sqrt(R*) and 8 G* sqrt(R*); damping from the fraction xi of critical (see
/// kernels/laws/restitution.hpp): c = sqrt(5) xi sqrt(m k) u^(1/4) = 2 sqrt(5/6) xi sqrt(m dF/du).
inline HertzMindlin hertz_mindlin(const ElasticBody& a, const ElasticBody& b, double xi, double friction) {
  const auto normal_compliance = [](const ElasticBody& e) { return (1.0 - e.poisson * e.poisson) / e.young; };
  const auto shear_compliance = [](const ElasticBody& e) {
    return (2.0 - e.poisson) * 2.0 * (1.0 + e.poisson) / e.young;
  };
  const double root = 1.0 / std::sqrt(a.curvature + b.curvature);
  return {4.0 / 3.0 * root / (normal_compliance(a) + normal_compliance(b)),  // (B34) (B35) (B36)
          8.0 * root / (shear_compliance(a) + shear_compliance(b)),
          2.0 * std::sqrt(5.0 / 6.0) * xi / std::sqrt(a.inverse_mass + b.inverse_mass), friction};
}

/// What a contact remembers from one step to the next.
struct ContactMemory {
  Vec3 shear;          ///< N, friction force on lo
  double overlap = 0;  ///< m, of the step before
};

/// How springs and dashpots of the contact go together. While it sticks, a tangential dashpot with
/// the same fraction of critical damping as the normal one acts beside the tangential spring
/// (Tsuji, Tanaka and Ishida 1992).
/// dissipative: never pulls; the tangential spring is incremental and gives back less while the
/// overlap shrinks, so that no path gains energy (Thornton, Cummins and Cleary, Powder Technol.
/// 233, 2013); friction is measured by the total normal force and limits spring and dashpot
/// together.
/// classic: as widely used codes have it, for comparison with them: pulls at the end of a
/// damped impact; the tangential spring force is the present stiffness times the stretch so
/// far; friction is measured by the normal spring alone and limits the tangential spring alone.
/// Some paths gain up to 4 % of tangential energy.
enum class HertzForm : unsigned char { dissipative, classic };

inline Vec3 cut_to(const Vec3& shear, double limit) {
  const double size = norm(shear);
  return size > limit ? (limit / size) * shear : shear;
}

/// Force on lo, N.
/// @param overlap  m, positive
/// @param memory   the shear force already carried along with the pair
inline Vec3 hertz_mindlin_force(const HertzMindlin& contact, HertzForm form, double overlap,
                                const Pair<double>& pair, double dt, ContactMemory& memory) {
  const bool classic = form == HertzForm::classic;
  const double root = std::sqrt(overlap), stiffness = contact.tangential * root;
  const double spring = contact.normal * overlap * root;  // (B34)
  const double damped = spring - contact.damping * std::sqrt(1.5 * contact.normal * root) * pair.rate;
  const double pressed = classic ? damped : larger(0.0, damped);
  const bool softens = overlap < memory.overlap, stiffens = classic && memory.overlap > 0.0;
  // (B35)
  if (softens || stiffens) memory.shear = std::sqrt(overlap / memory.overlap) * memory.shear;
  memory.shear += stiffness * pair.slip;
  memory.overlap = overlap;
  const double limit = contact.friction * (classic ? spring : pressed);  // (B37)
  const bool slides = dot(memory.shear, memory.shear) > limit * limit;
  memory.shear = cut_to(memory.shear, limit);
  Vec3 across = memory.shear;
  if (!slides) across += (contact.damping * std::sqrt(stiffness) / dt) * pair.slip;  // (B36)
  return (classic ? across : cut_to(across, limit)) - pressed * pair.normal;
}

/// The elastic impact in closed form: largest overlap, force, and how long the contact lasts
/// (4 sqrt(pi) Gamma(2/5)/(5 Gamma(9/10)) u/v).
struct HertzImpact {
  double overlap = 0, force = 0, duration = 0;  ///< m, N, s
};
/// @param normal        N/m^1.5
/// @param reduced_mass  kg
/// @param speed         m/s, of approach
inline HertzImpact hertz_impact(double normal, double reduced_mass, double speed) {
  const double u = std::pow(1.25 * reduced_mass * speed * speed / normal, 0.4);
  return {u, normal * std::pow(u, 1.5), 2.94327518 * u / speed};
}

}  // namespace breccia
