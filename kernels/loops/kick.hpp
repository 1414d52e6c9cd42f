// What a step does to one free particle: the same for both precisions. A particle's force and
// torque, velocity and spin go through the same operations, so they go side by side. Included by
// files that are compiled per instruction set only.
#pragma once
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
[[gnu::always_inline]] inline Kicked kicked(const Motion& m, std::size_t row, const Four& force,
                                            const Four& torque, double dt, const GlobalDamping& damping) {
  Kicked k;
  const Four rest{};
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

/// Sums over the rows of a range.
template <bool booked>
struct RangeSums {
  Two twice_kinetic{}, held_this{}, held_next{};
  Four gauge{};

  [[gnu::always_inline]] void add(const Kicked& k) {
    if constexpr (!booked) return;
    const Two across = products(k.velocity, k.new_velocity, k.spin, k.new_spin);
    twice_kinetic += k.inertia * across;  // (B48)
    // (B56)
    held_this += k.held * k.speeds;
    held_next += k.held * across;
  }
  [[gnu::always_inline]] void read_gauges(const Motion& m, std::size_t row, const Four& position) {
    if (!m.gauge_weights.empty()) gauge += four(m.gauge_weights[row]) * position;
  }
  Integrated of_step(double dt, unsigned events) const {
    const double half = 0.5 * dt;
    return {{0.5 * (twice_kinetic[0] + twice_kinetic[1]), half * held_this[0], half * held_next[0],
             half * held_this[1], half * held_next[1]},
            {gauge[0], gauge[1], gauge[2]},
            events};
  }
};

/// Calls go<spins, viscous, booked>() for a scene.
template <class Go>
[[gnu::always_inline]] inline Integrated for_scene(bool spins, bool viscous, bool booked, const Go& go) {
  const auto with_spins = [&]<bool s>() {
    const auto with_damping = [&]<bool v>() {
      return booked ? go.template operator()<s, v, true>() : go.template operator()<s, v, false>();
    };
    return viscous ? with_damping.template operator()<true>() : with_damping.template operator()<false>();
  };
  return spins ? with_spins.template operator()<true>() : with_spins.template operator()<false>();
}

}  // namespace
}  // namespace breccia::BRECCIA_ISA
