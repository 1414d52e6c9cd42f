// From particles in doubles to the records of the loop in single precision, and from its sums back.
// Compiled once per instruction set.
#include <bit>

#include "kernels/loops/kick.hpp"
#include "kernels/single/single.hpp"

namespace breccia::BRECCIA_ISA {
namespace {

using FourInts [[gnu::vector_size(16), gnu::may_alias]] = std::int32_t;
using FourWrapping [[gnu::vector_size(16)]] = std::uint32_t;
using FourLongs [[gnu::vector_size(32)]] = std::int64_t;

/// The nearest integers, modulo 2^32: what is added puts them into the low bits of the mantissa.
/// |a| < 2^50.
[[gnu::always_inline]] inline FourInts nearest(const Four& a) {
  constexpr double mantissa = 6755399441055744.0;  // 1.5 2^52
  const auto bits = std::bit_cast<FourLongs>(a + mantissa);
  return __builtin_convertvector(bits, FourInts);
}

[[gnu::always_inline]] inline Four larger(const Four& a, const Four& b) { return a > b ? a : b; }

[[gnu::always_inline]] inline FourInts& ints(std::int32_t (&row)[4]) {
  return *reinterpret_cast<FourInts*>(&row);
}

/// a - factor b, modulo 2^32.
[[gnu::always_inline]] inline FourInts less(const FourInts& a, const FourInts& b, std::uint32_t factor = 1) {
  return (FourInts)((FourWrapping)a - factor * (FourWrapping)b);
}

/// Most particles bear nothing but their bonds: what is zero is not written again.
[[gnu::always_inline]] inline void clear(Vec3& sum) {
  if (const auto bits = std::bit_cast<FourLongs>(four(sum)); bits[0] | bits[1] | bits[2]) four(sum) = Four{};
}

/// Writes a particle's record; looks at how far and how fast it is.
class Recorder {
public:
  Recorder(const RecordedMotion& motion, double dt)
      : m_(motion),
        per_quantum_(1.0 / motion.length),
        parts_(motion.length / motion.moved),
        fine_step_(dt / motion.moved),
        origin_{motion.origin.x, motion.origin.y, motion.origin.z, 0.0} {}

  [[gnu::always_inline]] void record(std::size_t row, const Four& position, const Four& velocity,
                                     const Four& spin) {
    MotionRecord& r = m_.records[row];
    const Four x = per_quantum_ * (position - origin_), motion = fine_step_ * velocity,
               turn = (fine_step_ * m_.radius[row]) * spin;
    farthest_ = larger(farthest_, x * x);
    fastest_ = larger(fastest_, larger(motion * motion, turn * turn));
    const FourInts place = less(nearest(x), ints(r.anchor), coarse_parts);
    displaced_ |= place ^ (place >> 31);
    // the fourth of each row: where the particle was, in quanta of motion, and where it is
    const FourInts fine = nearest(parts_ * x);
    const FourInts xy = __builtin_shufflevector(ints(r.place), ints(r.moved), 3, 7, 3, 7),
                   before = __builtin_shufflevector(xy, ints(r.spun), 0, 1, 7, 7);
    const FourInts moved = less(fine, before), spun = nearest(turn);
    ints(r.place) = __builtin_shufflevector(place, fine, 0, 1, 2, 4);
    ints(r.moved) = __builtin_shufflevector(moved, fine, 0, 1, 2, 5);
    ints(r.spun) = __builtin_shufflevector(spun, fine, 0, 1, 2, 6);
  }
  unsigned events() const {
    unsigned events = 0;
    for (int k = 0; k < 3; ++k) {
      if (displaced_[k] >= far_place) events |= place_is_far;
      if (fastest_[k] > fast_motion * fast_motion) events |= motion_is_fast;
      if (fastest_[k] > lost_motion * lost_motion || farthest_[k] > lost_place * lost_place)
        events |= motion_is_lost;
    }
    return events;
  }

private:
  const RecordedMotion m_;
  const double per_quantum_, parts_, fine_step_;
  const Four origin_;
  Four farthest_{}, fastest_{};  ///< squares
  FourInts displaced_{};         ///< has every bit that a displacement has
};

/// Views by value: what is stored through a vector could be one of them, for all a compiler knows
/// of a reference, and it would read them again for every row.
template <bool spins, bool viscous, bool booked>
Integrated move_and_record(const Motion m, const RecordedMotion to, const CollectedSums from,
                           std::size_t first, std::size_t last, double dt, const GlobalDamping damping) {
  RangeSums<booked> sums;
  Stretch together;
  Recorder recorder(to, dt);
  by_stretches(
      first, last, [&](std::size_t begin, std::size_t end) __attribute__((always_inline)) {
        const auto loads = [&](std::size_t row, Four & torque) __attribute__((always_inline)) {
          FourInts &bonds_force = ints(from.sums[row].force), &bonds_moment = ints(from.sums[row].moment);
          const Four force =
              four(m.force[row]) + from.force_quantum * __builtin_convertvector(bonds_force, Four);
          if constexpr (spins)
            torque = four(m.torque[row]) +
                     (from.force_quantum * from.radius[row]) * __builtin_convertvector(bonds_moment, Four);
          bonds_force = bonds_moment = FourInts{};
          clear(m.force[row]);
          if (!m.torque.empty()) clear(m.torque[row]);
          return force;
        };
        kick_and_drift<spins, viscous>(m, begin, end, dt, damping, loads, together, sums);
        for (std::size_t row = begin; row < end; ++row)
          recorder.record(row, four(m.position[row]), four(m.velocity[row]),
                          spins ? four(m.spin[row]) : Four{});
      });
  return sums.of_step(dt, recorder.events());
}

}  // namespace

Integrated integrate_single(const Motion& m, const RecordedMotion& to, const CollectedSums& from,
                            std::size_t first, std::size_t last, double dt, const GlobalDamping& damping,
                            bool booked) {
  return for_scene(!m.spin.empty() && m.spins, damping.viscous, booked, [&]<bool s, bool v, bool b>() {
    return move_and_record<s, v, b>(m, to, from, first, last, dt, damping);
  });
}

unsigned refresh_records(const RecordedMotion& m, std::size_t first, std::size_t last, double dt) {
  Recorder recorder(m, dt);
  for (std::size_t row = first; row < last; ++row)
    recorder.record(row, four(m.position[row]), four(m.velocity[row]),
                    m.spin.empty() ? Four{} : four(m.spin[row]));
  return recorder.events();
}

void collect_sums(const CollectedSums& c, std::size_t first, std::size_t last) {
  const bool turns = !c.torque.empty();
  for (std::size_t row = first; row < last; ++row) {
    FourInts &force = ints(c.sums[row].force), &moment = ints(c.sums[row].moment);
    four(c.force[row]) += c.force_quantum * __builtin_convertvector(force, Four);
    if (turns)
      four(c.torque[row]) += (c.force_quantum * c.radius[row]) * __builtin_convertvector(moment, Four);
    force = moment = FourInts{};
  }
}

}  // namespace breccia::BRECCIA_ISA
