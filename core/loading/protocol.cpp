#include "core/loading/protocol.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <numbers>

#include "core/base/hold.hpp"
#include "core/distributed/gather.hpp"
#include "core/distributed/halo.hpp"
#include "core/loading/instruments.hpp"
#include "core/loading/strength.hpp"
#include "core/stepping/step.hpp"
#include "core/world/energies.hpp"
#include "core/world/energy_accounting.hpp"
#include "core/world/stress.hpp"
#include "core/world/sync.hpp"

namespace breccia {
namespace {

using Clock = std::chrono::steady_clock;

/// 0 to 1 without a jump in speed. (B65)
double eased(double t, double duration) {
  return t >= duration ? 1.0 : 0.5 * (1.0 - std::cos(std::numbers::pi * t / duration));
}

/// s, for a wave to run from end to end. (B65)
double crossing_time(const World& w, const Assembly& a) {
  return a.length() / std::sqrt(w.material.young_modulus / w.material.density);
}

/// Broken bonds and energies at the end of a row.
CurveRow state_row(World& w) {
  finish_halo_exchange(w);
  const Lap lap(w.phases, Phase::measure);
  sync(w);
  CurveRow row;
  const BrokenCount broken = count_broken(w);
  row.broken_tension = static_cast<double>(broken.tension);
  row.broken_shear = static_cast<double>(broken.shear);
  row.kinetic_J = kinetic_energy(w);
  if (w.ledger.enabled) {
    const EnergyBalance energies = energy_balance(w);
    record_balance(w.ledger, energies);
    row.stored_J = energies.stored;
    row.dissipated_J = energies.dissipated();
    row.work_J = energies.work;
  } else {
    row.stored_J = stored_energy(w);
  }
  row.confining_stress_Pa = w.confinement.acting;
  return row;
}

/// What a run needs at hand.
struct Run {
  World& w;
  const Assembly& assembly;
  const LoadTest& test;
  const LoadHooks& hooks;
  LoadState& state;
  LoadResult& result;
  double run_time_before = 0;  ///< s, of the part up to the checkpoint that this one goes on from
  Clock::time_point begun = Clock::now();
  Clock::time_point told{};  ///< when the program was last told

  bool interrupted() const { return hooks.interrupted && hooks.interrupted(); }
  bool is_root() const { return w.partition.ranks.is_root(); }
};

void enter(Run& run, Stage stage) {
  run.state.stage = stage;
  run.state.stage_start = run.w.time;
}

void note_run_time(Run& run) {
  run.result.run_time = run.run_time_before + std::chrono::duration<double>(Clock::now() - run.begun).count();
}

/// Tells a program how far a run is, a few times a second, and what has cracked.
void tell(Run& run, int stage, double fraction, const CurveRow& row) {
  const std::size_t fresh = collect_cracks(run.w, row.axial_strain);
  if (!run.w.partition.ranks.is_root()) return;
  const std::vector<Crack>& cracks = root_replica(run.w).cracks.cracks;
  if (run.hooks.cracks && fresh > 0) {
    const Lap lap(run.w.phases, Phase::output);
    run.hooks.cracks(std::span(cracks).last(fresh));
  }
  run.state.cracks_told = cracks.size();
  hold_at(HoldPoint::crack, fresh);
  const auto now = Clock::now();
  if (!run.hooks.progress || now - run.told < std::chrono::milliseconds(100)) return;
  run.told = now;
  run.hooks.progress(stage, fraction, row);
}

/// Pictures of the state, evenly spaced over the run, and one at its end.
void frame_if_due(Run& run, double done, const CurveRow& row, bool last) {
  const int frames = run.test.frames;
  if (frames <= 0) return;
  if (!last && done * frames < static_cast<double>(run.state.frames)) return;
  const Lap lap(run.w.phases, Phase::output);
  if (run.hooks.frame) run.hooks.frame(run.w, run.state.frames, row);
  ++run.state.frames;
  if (run.is_root()) hold_at(HoldPoint::frame);
}

/// @returns true when the run is to end here, interrupted
bool checkpoint_if_due(Run& run) {
  const Ranks& ranks = run.w.partition.ranks;
  if (ranks.is_root()) hold_at(HoldPoint::row);
  const bool due = run.hooks.checkpoint_due && ranks.is_root() && run.hooks.checkpoint_due();
  double asked[] = {run.interrupted() ? 1.0 : 0.0, due ? 1.0 : 0.0};
  all_reduce_max(ranks, asked);
  const bool interrupted = asked[0] > 0.0;
  if (run.hooks.checkpoint && (interrupted || asked[1] > 0.0)) {
    const Lap lap(run.w.phases, Phase::checkpoint);
    note_run_time(run);
    gather_scalars(run.w);
    gather_surface_marks(run.state.checks, run.w);
    run.hooks.checkpoint(run.w, run.state, run.result);
  }
  if (interrupted) run.result.stopped = Stopped::interrupted;
  return interrupted;
}

/// The pressure on the mantle and on the platens; a shear box has it on its lid alone.
void set_pressure(const Run& run, double pressure) {
  run.w.platens.pressure = pressure;
  if (run.test.loading != Loading::shear) run.w.confinement.pressure = pressure;
}

/// Whether platens that are about to be stopped move at a tenth of the test's speed at most.
bool is_slow(const Run& run) {
  if (run.test.loading == Loading::shear) return true;  // a lid goes on under its pressure
  const auto& v = run.w.platens.velocity;
  return std::max(std::abs(v[0].z), std::abs(v[1].z)) < 0.1 * run.test.platen_speed;
}

/// Stage 1: the pressure rises until the specimen rests under it. (B67)
/// @returns false when interrupted, or when it does not come to rest: a stage that has not cannot
///          be followed by the next
bool press_hydrostatically(Run& run) {
  World& w = run.w;
  const double pressure = run.test.confinement, crossing = crossing_time(w, run.assembly);
  const double rise = 16.0 * crossing, patience = 400.0 * crossing;  // (B67)
  w.platens.servo = true;
  double stress = 0.0;  // mean since the last check
  constexpr int between_checks = 50;
  if (run.state.stage == Stage::not_begun) enter(run, Stage::pressing);
  const double start = run.state.stage_start;
  for (int k = 1;; ++k) {
    set_pressure(run, pressure * eased(w.time - start, rise));
    advance(w);
    ++run.result.stage1_steps;
    stress += axial_stress(w.platens) / between_checks;
    if (k % between_checks != 0) continue;
    CurveRow row = state_row(w);
    check(run.state.checks, w, row.kinetic_J, row.stored_J);
    row.time_s = w.time;
    row.axial_stress_Pa = stress;
    const double since = w.time - start;
    tell(run, 1, std::min(1.0, since / (2.0 * rise)), row);
    // the dashpot takes up what is missing of the pressure, so that half a per cent of a large one
    // leaves the platens nearly as fast as the test's (concrete at 100 MPa: 0.06 m/s); stopped dead
    // they would send a wave into the specimen, and the deviator would begin below zero what has
    // come loose flies or rattles on, and has no say in whether the specimen rests
    const auto rests = [&](double kinetic) { return kinetic < 1e-4 * row.stored_J; };
    if (since > rise && std::abs(stress - pressure) < 0.005 * pressure && is_slow(run) &&
        (rests(row.kinetic_J) || rests(kinetic_energy_of_bonded(w)))) {
      if (!rests(row.kinetic_J))
        run.result.warnings.push_back(
            fmt::format("what has come loose under {:.4g} MPa still moves: kinetic/stored {:.1e}; the bonded "
                        "specimen rests",
                        pressure * 1e-6, row.kinetic_J / row.stored_J));
      break;
    }
    if (since > patience) {
      run.result.warnings.push_back(
          fmt::format("the specimen did not come to rest under {:.4g} MPa within {:.3g} s: kinetic/stored "
                      "{:.1e}, axial stress {:.4g} MPa; it was not loaded",
                      pressure * 1e-6, patience, row.kinetic_J / row.stored_J, stress * 1e-6));
      run.result.stopped = Stopped::no_rest;
      return false;
    }
    if (checkpoint_if_due(run)) return false;
    stress = 0.0;
  }
  if (run.test.loading != Loading::shear) run.result.held_pressure = held_pressure(w);
  // the lid of a shear box stays under its pressure
  w.platens.servo = run.test.loading == Loading::shear;
  return true;
}

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
  const double inward = loading == Loading::tension ? -speed : speed;
  w.platens.velocity[0].z = inward;
  w.platens.velocity[1].z = -inward;
}

/// The instruments of a stage that is recorded: set to zero, and a first picture taken, unless a
/// checkpoint was made in it.
Instruments begin_or_go_on(Run& run, Stage stage) {
  const bool resumed = run.state.stage == stage;
  const Instruments in =
      make_instruments(run.w, run.assembly, run.test, resumed ? &run.state.zeros : nullptr);
  if (resumed) return in;
  enter(run, stage);
  run.state.zeros = in.zeros;
  frame_if_due(run, 0.0, CurveRow{}, false);
  return in;
}

/// Stage 2: platens at constant speed, after a ramp without a jump.
void load(Run& run) {
  World& w = run.w;
  const LoadTest& test = run.test;
  const Instruments in = begin_or_go_on(run, Stage::loading);
  const double width = test.loading == Loading::shear ? w.body.diameter : run.assembly.length();
  const double duration = test.stop_strain * width / (2.0 * test.platen_speed);
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

/// The hydrostatic stage as a test of its own: the pressure rises evenly, at the rate at which an
/// elastic specimen between platens of the given speed would take it up. (B68)
void press_evenly(Run& run) {
  World& w = run.w;
  const LoadTest& test = run.test;
  const Instruments in = begin_or_go_on(run, Stage::pressing);
  // (B68)
  const double rate = w.material.young_modulus * 2.0 * test.platen_speed / run.assembly.length();
  const double duration = test.confinement / rate,
               ramp = std::max(2.0 * crossing_time(w, run.assembly), 0.05 * duration);
  const double start = run.state.stage_start;
  w.platens.servo = true;
  Recorder& recorder = run.result.record;
  while (true) {
    double& pressure = run.state.pressure;
    pressure = std::min(test.confinement, pressure + w.dt * rate * eased(w.time - start, ramp));
    set_pressure(run, pressure);
    advance(w);
    const double done = pressure / test.confinement;
    if (!add_reading(recorder, read(w, in)) && done < 1.0) continue;
    const CurveRow row = close_row(recorder, state_row(w));
    check(run.state.checks, w, row.kinetic_J, row.stored_J);
    tell(run, 1, done, row);
    frame_if_due(run, done, row, done >= 1.0);
    if (done >= 1.0) {
      run.result.held_pressure = held_pressure(w);
      run.result.stopped = Stopped::pressure;
      return;
    }
    if (checkpoint_if_due(run)) return;
  }
}

}  // namespace

void run_load_test(World& w, const Assembly& assembly, const LoadTest& test, const LoadHooks& hooks,
                   LoadState& state, LoadResult& result) {
  Run run{w, assembly, test, hooks, state, result, result.run_time};
  if (state.stage == Stage::not_begun) state.checks = make_stability_checks(w);
  if (test.loading == Loading::hydrostatic)
    press_evenly(run);
  else if (test.confinement == 0.0 || state.stage == Stage::loading || press_hydrostatically(run))
    load(run);
  note_run_time(run);
}

void run_load_test(World& w, const Assembly& assembly, const LoadTest& test, const LoadHooks& hooks,
                   LoadResult& result) {
  LoadState state;
  run_load_test(w, assembly, test, hooks, state, result);
}

}  // namespace breccia
