// What a step does to free particles: the same for both precisions. A particle's force and torque,
// velocity and spin go through the same operations, so they go side by side. Included by files that
// are compiled per instruction set only.
#pragma once
#include <algorithm>

#include "kernels/loops/integrate.hpp"
#include "kernels/math/four.hpp"
#include "kernels/math/lane_rows.hpp"

namespace breccia::BRECCIA_ISA {
namespace {

using Two [[gnu::vector_size(16)]] = double;  // of the motion, of the spin

/// (a . c, b . d), of three components each.
[[gnu::always_inline]] inline Two products(const Four& a, const Four& c, const Four& b, const Four& d) {
  const Four ac = a * c, bd = b * d;
  return __builtin_shufflevector(ac, bd, 0, 4) + __builtin_shufflevector(ac, bd, 1, 5) +
         __builtin_shufflevector(ac, bd, 2, 6);
}

/// Sums over the rows of a range.
template <bool booked>
struct RangeSums {
  Two twice_kinetic{}, held_this{}, held_next{};
  Four gauge{};

  /// @param speeds   squares of velocity and spin before; across: their products with those after
  /// @param held     force of the global damping over the velocity, which it opposes
  /// @param inertia  kg, kg m^2
  [[gnu::always_inline]] void add(const Two& speeds, const Two& across, const Two& held, const Two& inertia) {
    twice_kinetic += inertia * across;  // (B48)
    // (B56)
    held_this += held * speeds;
    held_next += held * across;
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

/// Rows that are moved together: they stay in the first cache. A kick waits for a root between two
/// quotients, and a processor overlaps only as many rows as it has room for; so what is long to
/// wait for is worked out for all of them at once, in wide registers.
inline constexpr std::size_t stretch = 64;

/// What the rows of a stretch have in common with no other: motion first, spin second.
struct Stretch {
  Four force[stretch], torque[stretch];
  alignas(64) double speeds[2][stretch], forces[2][stretch];  ///< squares, before
  alignas(64) double inertia[2][stretch];                     ///< kg, kg m^2
  alignas(64) double held[2][stretch];  ///< force of the global damping over the velocity
  alignas(64) double kick[2][stretch];  ///< step over inertia

  static Two of(const double (&pair)[2][stretch], std::size_t k) { return Two{pair[0][k], pair[1][k]}; }
  static void put(double (&pair)[2][stretch], std::size_t k, const Two& values) {
    pair[0][k] = values[0], pair[1][k] = values[1];
  }
};

/// Brakes and kicks of the first `rows`, from squares and inertias.
template <bool viscous>
[[gnu::always_inline]] inline void work_out(Stretch& s, std::size_t rows, double dt,
                                            const GlobalDamping& damping) {
  const auto aligned = std::experimental::vector_aligned;
  const double parts[] = {damping.translation, damping.rotation};
  for (std::size_t c = 0; c < 2; ++c)
    for (std::size_t k = 0; k < rows; k += Lanes::size()) {
      const Lanes inertia(s.inertia[c] + k, aligned), speeds(s.speeds[c] + k, aligned);
      Lanes held = parts[c] * inertia;  // (B113)
      if constexpr (!viscous) {
        Lanes moves = sqrt(Lanes(s.forces[c] + k, aligned) / speeds);
        where(!(speeds > 0.0), moves) = 0.0;  // 0/0 where at rest
        held = parts[c] * moves;              // (P39) (P40)
      }
      held.copy_to(s.held[c] + k, aligned);
      Lanes(dt / inertia).copy_to(s.kick[c] + k, aligned);
    }
}

/// Kick and drift of rows [first, last).
/// @param loads  row -> its force; its torque by reference
template <bool spins, bool viscous, bool booked, class Loads>
[[gnu::always_inline]] inline void kick_and_drift(const Motion& m, std::size_t first, std::size_t last,
                                                  double dt, const GlobalDamping& damping, const Loads& loads,
                                                  Stretch& s, RangeSums<booked>& sums) {
  const Four rest{};
  for (std::size_t row = first; row < last; ++row) {
    const std::size_t k = row - first;
    s.torque[k] = rest;
    s.force[k] = loads(row, s.torque[k]);
    const Four velocity = four(m.velocity[row]), spin = spins ? four(m.spin[row]) : rest;
    Stretch::put(s.speeds, k, products(velocity, velocity, spin, spin));
    if constexpr (!viscous)
      Stretch::put(s.forces, k, products(s.force[k], s.force[k], s.torque[k], s.torque[k]));
    const double mass = m.mass[row];
    Stretch::put(s.inertia, k,
                 Two{mass, spins ? m.inertia_factor * mass * m.radius[row] * m.radius[row] : mass});
  }
  for (std::size_t k = last - first; k % Lanes::size() != 0; ++k) {  // the rest of the last register
    Stretch::put(s.speeds, k, Two{}), Stretch::put(s.forces, k, Two{});
    Stretch::put(s.inertia, k, Two{1.0, 1.0});
  }
  work_out<viscous>(s, last - first, dt, damping);
  for (std::size_t row = first; row < last; ++row) {
    const std::size_t k = row - first;
    const Four velocity = four(m.velocity[row]), spin = spins ? four(m.spin[row]) : rest;
    const Two held = Stretch::of(s.held, k), kick = Stretch::of(s.kick, k);
    const Four new_velocity = velocity + kick[0] * (s.force[k] - held[0] * velocity);      // (P1) (P6)
    const Four new_spin = spins ? spin + kick[1] * (s.torque[k] - held[1] * spin) : rest;  // (P2) (P9)
    if constexpr (booked)
      sums.add(Stretch::of(s.speeds, k), products(velocity, new_velocity, spin, new_spin), held,
               Stretch::of(s.inertia, k));
    four(m.velocity[row]) = new_velocity;
    if constexpr (spins) four(m.spin[row]) = new_spin;
    four(m.position[row]) += dt * new_velocity;  // (P7)
    sums.read_gauges(m, row, four(m.position[row]));
  }
}

/// Takes the rows of a range a stretch at a time: go(first, last).
template <class Go>
[[gnu::always_inline]] inline void by_stretches(std::size_t first, std::size_t last, const Go& go) {
  for (std::size_t begin = first; begin < last; begin += stretch) go(begin, std::min(begin + stretch, last));
}

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
