#include "core/stepping/look_at_single.hpp"

#include "core/base/error.hpp"
#include "core/world/single_precision.hpp"

namespace breccia {
namespace {

/// Steps between two looks: what is large at one look must not be lost before the next.
constexpr std::uint64_t looked_at_every = 8;

[[noreturn]] void refuse_wildness(const World& w, bool force) {
  const Quanta& q = w.single.quanta;
  if (force)
    fail<SimulationBroke>(
        "run.precision = \"single\": the force of a bond grew beyond {:.3g} N within {} steps, more than its "
        "sums can hold; take a smaller time.safety, or run.precision = \"double\"",
        2.0 * q.force_limit * q.force, looked_at_every);
  fail<SimulationBroke>(
      "run.precision = \"single\": a sphere is faster than {:.3g} m/s, or farther than {:.3g} m from the "
      "specimen, more than its record can hold; take a smaller time.safety, or run.precision = \"double\"",
      lost_motion / fine_parts * q.length / w.dt, lost_place * q.length);
}

}  // namespace

void look_at_single(World& w) {
  SingleStore& s = w.single;
  if (w.options.precision != Precision::single || w.step % looked_at_every != 0) return;
  const auto [large, lost, far, too_fast] = events_of_all(w);
  if (lost) refuse_wildness(w, true);
  if (too_fast) refuse_wildness(w, false);
  if (large) coarsen_force(s, w.laws);
  s.events = 0;
}

}  // namespace breccia
