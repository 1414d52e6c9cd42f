#include "core/stepping/look_at_single.hpp"

#include "core/base/error.hpp"
#include "core/distributed/halo.hpp"

namespace breccia {
namespace {

[[noreturn]] void refuse_wildness(const World& w, bool force) {
  const Quanta& q = w.single.quanta;
  if (force)
    fail<SimulationBroke>(
        "run.precision = \"single\": the force of a bond is no number any more; take a smaller "
        "time.safety, or run.precision = \"double\"");
  fail<SimulationBroke>(
      "run.precision = \"single\": a sphere, or its surface, is faster than {:.3g} m/s, or farther than "
      "{:.3g} m from the specimen, more than its record can hold; take a smaller time.safety, or "
      "run.precision = \"double\"",
      lost_motion * q.motion / w.dt, lost_place * q.length);
}

}  // namespace

void look_at_single(World& w) {
  SingleStore& s = w.single;
  if (s.events & force_is_lost) refuse_wildness(w, true);
  if (s.events & motion_is_lost) refuse_wildness(w, false);
  if (s.events & force_is_large) coarsen_force(s, w.laws);
  if (s.events & motion_is_fast) {
    finish_halo_exchange(w);
    coarsen_motion(s, w.particles);
  }
  s.events = 0;
}

}  // namespace breccia
