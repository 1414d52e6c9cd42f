#include "core/stepping/look_at_single.hpp"

#include "core/base/error.hpp"

namespace breccia {
namespace {

[[noreturn]] void refuse_wildness(const World& w, bool force) {
  const Quanta& q = w.single.quanta;
  if (force)
    fail<SimulationBroke>(
        "run.precision = \"single\": the force of a bond grew beyond {:.3g} N in one step, more than its "
        "sums can hold; take a smaller time.safety, or run.precision = \"double\"",
        4.0 * q.force_limit * q.force);
  fail<SimulationBroke>(
      "run.precision = \"single\": a sphere is faster than {:.3g} m/s, or farther than {:.3g} m from the "
      "specimen, more than its record can hold; take a smaller time.safety, or run.precision = \"double\"",
      lost_motion / fine_parts * q.length / w.dt, lost_place * q.length);
}

}  // namespace

void look_at_single(World& w) {
  SingleStore& s = w.single;
  if (s.events & force_is_lost) refuse_wildness(w, true);
  if (s.events & motion_is_lost) refuse_wildness(w, false);
  if (s.events & force_is_large) coarsen_force(s, w.laws);
  s.events = 0;
}

}  // namespace breccia
