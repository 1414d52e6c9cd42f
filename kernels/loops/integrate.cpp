#include "kernels/loops/integrate.hpp"

namespace breccia {
namespace {

void kick_spin(const Motion& m, std::size_t row, double dt, const GlobalDamping& damping) {
  if (m.spin.empty()) return;
  if (!m.spins) {
    m.torque[row] = {};
    return;
  }
  const double i = inertia(m.inertia_factor, m.mass[row], m.radius[row]);
  const double brake = brake_on(m.spin[row], m.torque[row], damping.rotation, damping.viscous, i);
  m.spin[row] += (dt / i) * (m.torque[row] - brake * m.spin[row]);  // (P9)
  m.torque[row] = {};
}

}  // namespace

void integrate_held(const Motion& m, std::size_t first, std::size_t last, double dt,
                    const GlobalDamping& damping, const HeldMotion& held) {
  for (std::size_t row = first; row < last; ++row) {
    Vec3 v = m.velocity[row];
    if (!held.lateral_free) {
      v.x = held.velocity.x;
      v.y = held.velocity.y;
    } else {
      const Vec3 lateral{m.force[row].x, m.force[row].y, 0.0};
      const Vec3 before{v.x, v.y, 0.0};
      const double brake = brake_on(before, lateral, damping.translation, damping.viscous, m.mass[row]);
      const Vec3 force = lateral - brake * before;
      v.x += dt / m.mass[row] * force.x;  // (P6)
      v.y += dt / m.mass[row] * force.y;
    }
    v.z = held.velocity.z;
    m.velocity[row] = v;
    m.position[row] += dt * v;  // (P7)
    m.force[row] = {};
    kick_spin(m, row, dt, damping);
  }
}

}  // namespace breccia
