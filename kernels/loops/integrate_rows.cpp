// The integration of free particles, compiled once per instruction set like the bond pass.
#include "kernels/loops/kick.hpp"

namespace breccia::BRECCIA_ISA {
namespace {

/// Views by value: what is stored through a vector could be one of them, for all a compiler knows
/// of a reference, and it would read them again for every row.
template <bool spins, bool viscous, bool booked>
Integrated move_rows(const Motion m, std::size_t first, std::size_t last, double dt,
                     const GlobalDamping damping) {
  RangeSums<booked> sums;
  Stretch together;
  by_stretches(
      first, last, [&](std::size_t begin, std::size_t end) __attribute__((always_inline)) {
        const auto loads = [&](std::size_t row, Four & torque) __attribute__((always_inline)) {
          const Four force = four(m.force[row]);
          if constexpr (spins) torque = four(m.torque[row]);
          four(m.force[row]) = Four{};
          if (!m.torque.empty()) four(m.torque[row]) = Four{};
          return force;
        };
        kick_and_drift<spins, viscous>(m, begin, end, dt, damping, loads, together, sums);
      });
  return sums.of_step(dt, 0);
}

}  // namespace

Integrated integrate_free(const Motion& m, std::size_t first, std::size_t last, double dt,
                          const GlobalDamping& damping, bool booked) {
  return for_scene(!m.spin.empty() && m.spins, damping.viscous, booked,
                   [&]<bool s, bool v, bool b>() { return move_rows<s, v, b>(m, first, last, dt, damping); });
}

}  // namespace breccia::BRECCIA_ISA
