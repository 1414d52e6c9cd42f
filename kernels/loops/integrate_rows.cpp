// The integration of free particles, compiled once per instruction set like the bond pass.
#include "kernels/loops/kick.hpp"

namespace breccia::BRECCIA_ISA {
namespace {

/// Views by value: what is stored through a vector could be one of them, for all a compiler knows
/// of a reference, and it would read them again for every row.
template <bool spins, bool viscous, bool booked>
Integrated kick_and_drift(const Motion m, std::size_t first, std::size_t last, double dt,
                          const GlobalDamping damping) {
  RangeSums<booked> sums;
  for (std::size_t row = first; row < last; ++row) {
    const Four torque = spins ? four(m.torque[row]) : Four{};
    const Kicked k = kicked<spins, viscous>(m, row, four(m.force[row]), torque, dt, damping);
    sums.add(k);
    four(m.velocity[row]) = k.new_velocity;
    four(m.position[row]) += dt * k.new_velocity;  // (P7)
    sums.read_gauges(m, row, four(m.position[row]));
    four(m.force[row]) = Four{};
    if constexpr (spins) four(m.spin[row]) = k.new_spin;
    if (!m.torque.empty()) four(m.torque[row]) = Four{};
  }
  return sums.of_step(dt, 0);
}

}  // namespace

Integrated integrate_free(const Motion& m, std::size_t first, std::size_t last, double dt,
                          const GlobalDamping& damping, bool booked) {
  return for_scene(!m.spin.empty() && m.spins, damping.viscous, booked, [&]<bool s, bool v, bool b>() {
    return kick_and_drift<s, v, b>(m, first, last, dt, damping);
  });
}

}  // namespace breccia::BRECCIA_ISA
