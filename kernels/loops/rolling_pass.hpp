// Resistance to rolling where surfaces press without a bond: broken bonds and contacts. A pass of
// its own behind that over their forces, for scenes that ask for it.
#pragma once
#include "kernels/laws/rolling_friction.hpp"
#include "kernels/loops/scatter.hpp"

namespace breccia {

/// The particles, and the constants of the scene.
struct RollingScene {
  double dt = 0;              ///< s
  double friction = 0;        ///< mu_r
  double inertia_factor = 0;  ///< I = factor m r^2
  Strided<const Vec3> position, spin;
  std::span<const double> radius, mass;
};

/// Pairs that may press; spans by row. Damage is empty where nothing was ever bonded.
struct RollingPairs {
  std::span<const Index> row_lo, row_hi;
  std::span<const double> free_length, plastic_stretch, stiffness, damage_normal, damage_shear;
  std::span<Vec3> couple;  ///< N m, on lo, of the step before; brought up to this one

  /// N, with which surfaces press; nothing through a bond.
  double pressed(std::size_t k, double distance) const {
    if (!damage_normal.empty() && damage_normal[k] < 1.0 && damage_shear[k] < 1.0) return 0.0;
    const double plastic = plastic_stretch.empty() ? 0.0 : plastic_stretch[k];
    return larger(0.0, stiffness[k] * (free_length[k] + plastic - distance));
  }
};

/// Torques on the lower ends of pairs [first, last), opposite ones on the upper ends. (B116)
/// @param book  book(pair, J): what rolling has taken over this step
template <class Book>
void rolling_pass(const RollingScene& scene, const RollingPairs& pairs, std::size_t first, std::size_t last,
                  Scatter to, const Book& book) {
  to.force = to.torque;  // equal and opposite, as forces are
  to.torque = {};
  ForceBuffer block;
  while (first < last) {
    const std::size_t count = last - first < ForceBuffer::capacity ? last - first : ForceBuffer::capacity;
    bool rolls = false;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t at = first + k;
      const Index lo = pairs.row_lo[at], hi = pairs.row_hi[at];
      const Vec3 l = scene.position[hi] - scene.position[lo];
      const double distance = norm(l), force = pairs.pressed(at, distance);
      Vec3 couple;
      Vec3& before = pairs.couple[at];
      if (force > 0.0) {
        const double a = scene.radius[lo], b = scene.radius[hi];
        const Vec3 rolling = rolling_spin(scene.spin[lo], scene.spin[hi], (1.0 / distance) * l);
        const double ia = scene.inertia_factor * scene.mass[lo] * a * a,
                     ib = scene.inertia_factor * scene.mass[hi] * b * b;
        // a particle may have a dozen neighbours that all brake it: each takes a tenth of the
        // spin in a step
        couple = constant_rolling_torque(rolling, scene.friction * a * b / (a + b) * force,
                                         0.1 * ia * ib / (ia + ib), scene.dt);
      }
      if (!(before == Vec3{}) || !(couple == Vec3{})) {
        book(at, -0.5 * scene.dt * dot(before + couple, scene.spin[lo] - scene.spin[hi]));
        rolls = true;
      }
      before = couple;
      block.load[k] = {couple, {}};
    }
    if (rolls || to.mode == ScatterMode::column) scatter(to, block, first, count);
    first += count;
  }
}

}  // namespace breccia
