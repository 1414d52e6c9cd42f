// Resistance to rolling where surfaces press without a bond: broken bonds and contacts. A pass of
// its own behind that over their forces, for scenes that ask for it.
#pragma once
#include "kernels/laws/pair_kinematics.hpp"
#include "kernels/laws/rolling_friction.hpp"
#include "kernels/loops/scatter.hpp"

namespace breccia {

/// The particles, and the constants of the scene.
struct RollingScene {
  double dt = 0;           ///< s
  double friction = 0;     ///< mu_r
  double shear_ratio = 0;  ///< k_s/k_n
  Strided<const Vec3> position, velocity, spin;
  std::span<const double> radius;

  Ends<double> ends(Index lo, Index hi) const {
    const auto end = [&](Index row) { return End<double>{position[row], velocity[row], spin[row]}; };
    return ends_of(end(lo), end(hi));
  }
};

/// Pairs that may press; spans by row. Damage is empty where nothing was ever bonded.
struct RollingPairs {
  std::span<const Index> row_lo, row_hi;
  std::span<const double> free_length, plastic_stretch, stiffness, damage_normal, damage_shear;
  std::span<Vec3> couple;                     ///< N m, on lo
  std::span<const double> hertz_normal = {};  ///< N/m^1.5; empty: linear

  /// N, with which surfaces press; nothing through a bond.
  double pressed(std::size_t k, double distance) const {
    if (!damage_normal.empty() && damage_normal[k] < 1.0 && damage_shear[k] < 1.0) return 0.0;
    const double plastic = plastic_stretch.empty() ? 0.0 : plastic_stretch[k];
    const double overlap = larger(0.0, free_length[k] + plastic - distance);
    return hertz_normal.empty() ? stiffness[k] * overlap : hertz_normal[k] * overlap * std::sqrt(overlap);
  }
};

/// (B116): N m per rad, of a spring against rolling, k_s R^2 with R = r_i r_j/(r_i + r_j).
inline double rolling_stiffness(double shear_stiffness, double radius_lo, double radius_hi) {
  const double lever = radius_lo * radius_hi / (radius_lo + radius_hi);
  return shear_stiffness * lever * lever;
}

/// Brings the couple of a pair up to date. (B116)
/// @param book  book(pair, J): what rolling has taken over this step
/// @returns false where there is none
template <class Book>
bool roll(const RollingScene& scene, const RollingPairs& pairs, std::size_t at, const Book& book) {
  const Index lo = pairs.row_lo[at], hi = pairs.row_hi[at];
  Vec3& couple = pairs.couple[at];
  const double force = pairs.pressed(at, norm(scene.position[hi] - scene.position[lo]));
  if (!(force > 0.0) && couple == Vec3{}) return false;
  const double a = scene.radius[lo], b = scene.radius[hi];
  const double spring = rolling_stiffness(scene.shear_ratio * pairs.stiffness[at], a, b);
  const Pair<double> pair = relative_motion<true>(scene.ends(lo, hi), 0.0, scene.dt);
  const Vec3 rolling = rolling_spin(scene.spin[lo], scene.spin[hi], pair.normal);
  const Vec3 turned = rotate_with_pair<true>(couple, pair);
  const double limit = scene.friction * a * b / (a + b) * force;
  couple = slipping_rolling_torque(turned, rolling, spring, limit, scene.dt);
  const double kept = spring > 0.0 ? 0.5 * (dot(couple, couple) - dot(turned, turned)) / spring : 0.0;
  book(at, -0.5 * scene.dt * dot(turned + couple, rolling) - kept);
  return true;
}

/// Couples on the lower ends of pairs [first, last), opposite ones on the upper ends.
/// @param update  update(pair): brings its couple up to date, false where there is none
template <class Update>
void couple_pass(std::span<const Vec3> couple, std::size_t first, std::size_t last, Scatter to,
                 const Update& update) {
  to.force = to.torque;  // equal and opposite, as forces are
  to.torque = {};
  ForceBuffer block;
  while (first < last) {
    const std::size_t count = last - first < ForceBuffer::capacity ? last - first : ForceBuffer::capacity;
    bool acts = false;
    for (std::size_t k = 0; k < count; ++k) {
      acts = update(first + k) || acts;
      block.load[k] = {couple[first + k], {}};
    }
    if (acts || to.mode == ScatterMode::column) scatter(to, block, first, count);
    first += count;
  }
}

}  // namespace breccia
