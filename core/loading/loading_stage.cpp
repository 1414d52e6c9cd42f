#include <algorithm>
#include <cmath>

#include "core/base/hold.hpp"
#include "core/loading/stages.hpp"
#include "core/loading/strength.hpp"
#include "core/stepping/step.hpp"

namespace breccia {
namespace {

double deviator(const CurveRow& row) { return row.axial_stress_Pa - row.confining_stress_Pa; }

bool on_envelope(const LoadPath& d, const CurveRow& row) {
  return d.sense > 0.0 && row.platen_strain >= d.turned_at;
}

/// Unloads where the test asks for it, and loads again. (B69)
void follow(Run& run, const CurveRow& row) {
  const LoadTest& test = run.test;
  LoadPath& d = run.state.direction;
  std::size_t& next = run.state.next_unloading;
  if (d.sense > 0.0 && next < test.unload_at.size() && row.platen_strain >= test.unload_at[next]) {
    d = {-1.0, row.platen_strain, deviator(row)};
    run.result.cycles.push_back({row.time_s, 0.0});
  } else if (d.sense < 0.0 && deviator(row) <= test.unload_to * d.load) {
    d.sense = 1.0;
    ++next;
    run.result.cycles.back().reloaded = row.time_s;
  }
}

/// True when the stress has come down from its peak by the fraction asked for. (B70)
bool has_dropped(Run& run, const CurveRow& row) {
  if (run.test.loading == Loading::cutting) return false;  // each chip is a drop
  double& peak = run.state.peak;
  const double strength = run.test.loading == Loading::shear ? row.axial_stress_Pa : deviator(row);
  peak = std::max(peak, strength);
  const double fraction = run.test.stop_after_peak;
  return fraction > 0.0 && strength < (1.0 - fraction) * peak &&
         can_be_strength(peak, run.test.confinement, run.result.record.mismatch);
}

/// A lid that moves steadily, because the band below it dilates, leans on its dashpot: the stress
/// is off by what the dashpot takes up (at 0.1 m/s half of 1 MPa). So the pressure that drives it
/// is raised by what has been missing, over half a crossing; with the lid's mass m and dashpot c
/// that is stable beyond m/c, which is 0.3 crossings, however soft the band (Routh).
void hold_normal_stress(World& w, double wanted, double crossing) {
  Platens& p = w.platens;
  // (B101)
  p.pressure += std::min(1.0, 2.0 * w.dt / crossing) * (wanted - axial_stress(p));
}

void set_speed(World& w, Loading loading, double speed) {
  if (loading == Loading::shear) {
    w.platens.velocity[0].x = -speed;
    w.platens.velocity[1].x = speed;
    return;
  }
  if (loading == Loading::cutting) {
    w.tool.speed = speed;
    return;
  }
  const double inward = loading == Loading::tension ? -speed : speed;
  w.platens.velocity[0].z = inward;
  w.platens.velocity[1].z = -inward;
}

}  // namespace

void load(Run& run) {
  World& w = run.w;
  const LoadTest& test = run.test;
  w.platens.rough = w.options.rough_platens;  // (B110): stage 1 left the ends free
  const Instruments in = begin_or_go_on(run, Stage::loading);
  const bool cuts = test.loading == Loading::cutting;
  const double width = test.loading == Loading::shear || cuts ? w.body.diameter : run.assembly.length();
  const double duration = test.stop_strain * width / ((cuts ? 1.0 : 2.0) * test.platen_speed);
  const double crossing = crossing_time(w, run.assembly);
  const double ramp = std::max(2.0 * crossing, 0.05 * duration);
  const double start = run.state.stage_start;
  Recorder& recorder = run.result.record;
  while (true) {
    double& speed = run.state.speed;
    // (B65)
    const double wanted = run.state.direction.sense * test.platen_speed * eased(w.time - start, ramp);
    // platens that turn back do it within a crossing or two
    speed = test.unload_at.empty() ? wanted : speed + std::min(1.0, w.dt / crossing) * (wanted - speed);
    set_speed(w, test.loading, speed);
    if (test.loading == Loading::shear) hold_normal_stress(w, test.confinement, crossing);
    advance(w);
    if (run.is_root()) hold_at(HoldPoint::step);
    const double done = travel(w, in) / (test.stop_strain * width);
    if (!add_reading(recorder, read(w, in)) && done < 1.0) continue;
    const CurveRow row = close_row(recorder, state_row(w));
    check(run.state.checks, w, row.kinetic_J, row.stored_J);
    tell(run, 2, done, row);
    follow(run, row);
    const bool dropped =
        on_envelope(run.state.direction, row) && has_dropped(run, row) && w.time - start > ramp;
    const bool last = done >= 1.0 || dropped;
    frame_if_due(run, done, row, last);
    if (last) {
      run.result.stopped = dropped ? Stopped::peak_drop : Stopped::strain;
      return;
    }
    if (checkpoint_if_due(run)) return;
  }
}

}  // namespace breccia
