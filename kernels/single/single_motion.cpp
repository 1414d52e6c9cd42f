// From particles in doubles to the records of the loop in single precision, and from its sums back.
// Compiled once per instruction set.
#include <bit>

#include "kernels/math/four.hpp"
#include "kernels/single/single.hpp"

namespace breccia::BRECCIA_ISA {
namespace {

using FourInts [[gnu::vector_size(16), gnu::may_alias]] = std::int32_t;
using FourLongs [[gnu::vector_size(32)]] = std::int64_t;

/// The nearest integers, modulo 2^32: what is added puts them into the low bits of the mantissa.
/// |a| < 2^50.
[[gnu::always_inline]] inline FourInts nearest(const Four& a) {
  constexpr double mantissa = 6755399441055744.0;  // 1.5 2^52
  const auto bits = std::bit_cast<FourLongs>(a + mantissa);
  return __builtin_convertvector(bits, FourInts);
}

[[gnu::always_inline]] inline FourInts& ints(std::int32_t (&row)[4]) {
  return *reinterpret_cast<FourInts*>(&row);
}

}  // namespace

unsigned refresh_records(const RecordedMotion& m, std::size_t first, std::size_t last, double dt) {
  const double per_quantum = 1.0 / m.length, spin_unit = fine_parts * dt * per_quantum;
  const Four origin{m.origin.x, m.origin.y, m.origin.z, 0.0};
  const double motion_unit = fine_parts * dt * per_quantum;
  Four farthest{}, fastest{};
  for (std::size_t row = first; row < last; ++row) {
    MotionRecord& r = m.records[row];
    const Four place = per_quantum * ((four(m.position[row]) - origin) - four(m.anchor[row]));
    const Four motion = motion_unit * four(m.velocity[row]);
    farthest = farthest > place * place ? farthest : place * place;
    fastest = fastest > motion * motion ? fastest : motion * motion;
    const FourInts anchor = ints(r.anchor);
    const FourInts fine = nearest(fine_parts * place) + fine_parts * coarse_parts * anchor;
    const FourInts before{r.place[3], r.moved[3], r.spun[3], 0};
    FourInts now = nearest(place), moved = fine - before, spun{};
    if (!m.spin.empty()) spun = nearest((spin_unit * m.radius[row]) * four(m.spin[row]));
    now[3] = fine[0], moved[3] = fine[1], spun[3] = fine[2];
    ints(r.place) = now, ints(r.moved) = moved, ints(r.spun) = spun;
  }
  unsigned events = 0;
  for (int k = 0; k < 3; ++k) {
    if (!(farthest[k] <= far_place * far_place)) events |= place_is_far;
    if (!(fastest[k] <= lost_motion * lost_motion)) events |= motion_is_lost;
  }
  return events;
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
