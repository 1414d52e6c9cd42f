// The integration of free particles, compiled once per instruction set like the bond pass. A particle's force
// and torque, velocity and spin go through the same operations, so they go side by side.
#include "kernels/four.hpp"
#include "kernels/integrate.hpp"

namespace breccia::BRECCIA_ISA {
namespace {

using Two [[gnu::vector_size(16)]] = double;  // of the motion, of the spin

/// (a . a, b . b), of three components each.
[[gnu::always_inline]] inline Two squares(const Four& a, const Four& b) {
  const Four aa = a * a, bb = b * b;
  return __builtin_shufflevector(aa, bb, 0, 4) + __builtin_shufflevector(aa, bb, 1, 5) +
         __builtin_shufflevector(aa, bb, 2, 6);
}

[[gnu::always_inline]] inline Two square_roots(const Two& a) { return __builtin_ia32_sqrtpd(a); }

template <bool spins>
void kick_and_drift(const Motion& m, std::size_t first, std::size_t last, double dt,
                    const GlobalDamping& damping) {
  const Two alpha{damping.translation, damping.rotation};
  const Four rest{};
  for (std::size_t row = first; row < last; ++row) {
    const Four force = four(m.force[row]), torque = spins ? four(m.torque[row]) : rest;
    Four velocity = four(m.velocity[row]), spin = spins ? four(m.spin[row]) : rest;
    const Two speeds = squares(velocity, spin);
    const Two moves =
        speeds > Two{} ? square_roots(squares(force, torque) / speeds) : Two{};  // 0/0 where at rest
    const Two held = alpha * moves;
    const double mass = m.mass[row];
    const Two kick =
        Two{dt, dt} / Two{mass, spins ? m.inertia_factor * mass * m.radius[row] * m.radius[row] : mass};
    velocity += kick[0] * (force - held[0] * velocity);
    four(m.velocity[row]) = velocity;
    four(m.position[row]) += dt * velocity;
    four(m.force[row]) = rest;
    if constexpr (spins) {
      spin += kick[1] * (torque - held[1] * spin);
      four(m.spin[row]) = spin;
      four(m.torque[row]) = rest;
    }
  }
}

}  // namespace

void integrate_free(const Motion& m, std::size_t first, std::size_t last, double dt,
                    const GlobalDamping& damping) {
  if (!m.spin.empty() && m.spins) {
    kick_and_drift<true>(m, first, last, dt, damping);
    return;
  }
  kick_and_drift<false>(m, first, last, dt, damping);
  for (std::size_t row = first; row < last && !m.torque.empty(); ++row) four(m.torque[row]) = Four{};
}

}  // namespace breccia::BRECCIA_ISA
