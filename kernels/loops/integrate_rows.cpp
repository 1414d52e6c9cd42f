// The integration of free particles, compiled once per instruction set like the bond pass. A
// particle's force and torque, velocity and spin go through the same operations, so they go side by
// side.
#include "kernels/loops/integrate.hpp"
#include "kernels/math/four.hpp"

namespace breccia::BRECCIA_ISA {
namespace {

using Two [[gnu::vector_size(16)]] = double;  // of the motion, of the spin

/// (a . c, b . d), of three components each.
[[gnu::always_inline]] inline Two products(const Four& a, const Four& c, const Four& b, const Four& d) {
  const Four ac = a * c, bd = b * d;
  return __builtin_shufflevector(ac, bd, 0, 4) + __builtin_shufflevector(ac, bd, 1, 5) +
         __builtin_shufflevector(ac, bd, 2, 6);
}

[[gnu::always_inline]] inline Two square_roots(const Two& a) { return __builtin_ia32_sqrtpd(a); }

/// A particle before and after its forces have kicked it: motion and spin.
struct Kicked {
  Four velocity, spin, new_velocity, new_spin;
  Two speeds;   ///< squares of velocity and spin before
  Two held;     ///< force of the global damping over the velocity, which it opposes
  Two inertia;  ///< kg, kg m^2
};

template <bool spins, bool viscous>
[[gnu::always_inline]] inline Kicked kicked(const Motion& m, std::size_t row, double dt,
                                            const GlobalDamping& damping) {
  Kicked k;
  const Four rest{};
  const Four force = four(m.force[row]), torque = spins ? four(m.torque[row]) : rest;
  k.velocity = four(m.velocity[row]), k.spin = spins ? four(m.spin[row]) : rest;
  k.speeds = products(k.velocity, k.velocity, k.spin, k.spin);
  const double mass = m.mass[row];
  k.inertia = Two{mass, spins ? m.inertia_factor * mass * m.radius[row] * m.radius[row] : mass};
  if constexpr (viscous) {
    k.held = Two{damping.translation, damping.rotation} * k.inertia;  // (B113)
  } else {
    const Two moves = k.speeds > Two{} ? square_roots(products(force, force, torque, torque) / k.speeds)
                                       : Two{};  // 0/0 where at rest
    // (P39) (P40)
    k.held = Two{damping.translation, damping.rotation} * moves;
  }
  const Two kick = Two{dt, dt} / k.inertia;
  k.new_velocity = k.velocity + kick[0] * (force - k.held[0] * k.velocity);  // (P1) (P6)
  // (P2) (P9)
  k.new_spin = spins ? k.spin + kick[1] * (torque - k.held[1] * k.spin) : rest;
  return k;
}

/// Sums of what kicks do.
struct Books {
  Two twice_kinetic{}, held_this{}, held_next{};

  void add(const Kicked& k) {
    const Two across = products(k.velocity, k.new_velocity, k.spin, k.new_spin);
    twice_kinetic += k.inertia * across;  // (B48)
    // (B56)
    held_this += k.held * k.speeds;
    held_next += k.held * across;
  }
  MotionWork work(double dt) const {
    const double half = 0.5 * dt;
    return {0.5 * (twice_kinetic[0] + twice_kinetic[1]), half * held_this[0], half * held_next[0],
            half * held_this[1], half * held_next[1]};
  }
};

template <bool spins, bool viscous, bool booked>
MotionWork kick_and_drift(const Motion& m, std::size_t first, std::size_t last, double dt,
                          const GlobalDamping& damping) {
  Books books;
  for (std::size_t row = first; row < last; ++row) {
    const Kicked k = kicked<spins, viscous>(m, row, dt, damping);
    if constexpr (booked) books.add(k);
    four(m.velocity[row]) = k.new_velocity;
    four(m.position[row]) += dt * k.new_velocity;  // (P7)
    four(m.force[row]) = Four{};
    if constexpr (spins) {
      four(m.spin[row]) = k.new_spin;
      four(m.torque[row]) = Four{};
    }
  }
  return books.work(dt);
}

template <bool booked>
MotionWork integrate_rows(const Motion& m, std::size_t first, std::size_t last, double dt,
                          const GlobalDamping& damping) {
  if (!m.spin.empty() && m.spins)
    return damping.viscous ? kick_and_drift<true, true, booked>(m, first, last, dt, damping)
                           : kick_and_drift<true, false, booked>(m, first, last, dt, damping);
  for (std::size_t row = first; row < last && !m.torque.empty(); ++row) four(m.torque[row]) = Four{};
  return damping.viscous ? kick_and_drift<false, true, booked>(m, first, last, dt, damping)
                         : kick_and_drift<false, false, booked>(m, first, last, dt, damping);
}

}  // namespace

void integrate_free(const Motion& m, std::size_t first, std::size_t last, double dt,
                    const GlobalDamping& damping) {
  integrate_rows<false>(m, first, last, dt, damping);
}

MotionWork integrate_booked(const Motion& m, std::size_t first, std::size_t last, double dt,
                            const GlobalDamping& damping) {
  return integrate_rows<true>(m, first, last, dt, damping);
}

}  // namespace breccia::BRECCIA_ISA
