#include "core/load_test.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <numbers>

#include "core/guards.hpp"

namespace breccia {
namespace {

using Clock = std::chrono::steady_clock;

/// 0 to 1 without a jump in speed.
double eased(double t, double duration) {
  return t >= duration ? 1.0 : 0.5 * (1.0 - std::cos(std::numbers::pi * t / duration));
}

/// s, for a wave to run from end to end.
double crossing_time(const World& w, const Assembly& a) {
  return a.length() / std::sqrt(w.material.young_modulus / w.material.density);
}

/// The instruments: gauges on the specimen, and where everything stood when loading began.
struct Instruments {
  Gauge axial, lateral;
  double axial_zero = 0, lateral_zero = 0, approach_zero = 0, shear_zero = 0;
  double free_length = 0;  ///< m, between the held layers
  double sign = 1;         ///< -1: tension counts positive
  int lateral_directions = 2;
  Loading loading = Loading::compression;
  Grip grip = Grip::ends;
};

double gauge_now(const World& w, const Gauge& g) {
  return read_gauge(g, w.particles.position, w.particles.reference_position);
}

Instruments instruments_of(const World& w, const Assembly& a, const LoadTest& test) {
  Instruments in;
  in.loading = test.loading;
  in.grip = a.grip;
  in.sign = test.loading == Loading::tension ? -1.0 : 1.0;
  in.lateral_directions = a.space == Space::plane ? 1 : 2;
  if (a.grip == Grip::ends) in.axial = axial_gauge(a);
  if (a.grip != Grip::halves) in.lateral = lateral_gauge(a);
  in.axial_zero = gauge_now(w, in.axial);
  in.lateral_zero = gauge_now(w, in.lateral);
  in.approach_zero = approach(w.platens);
  in.shear_zero = shear_travel(w.platens);
  in.free_length = a.length() - 2.0 * a.layer;
  return in;
}

Reading read(World& w, const Instruments& in) {
  const Lap lap(w.phases, Phase::measure);
  Reading r;
  r.time = w.time;
  r.confining_stress = w.confinement.pressure;
  if (in.loading == Loading::shear) {
    // of a shear box: the strain is the shift over its width, the stress is that of the band
    r.axial_strain = r.platen_strain = (shear_travel(w.platens) - in.shear_zero) / w.body.diameter;
    r.axial_stress = shear_stress(w.platens);
    r.confining_stress = axial_stress(w.platens);
    r.radial_strain = CurveRow::untracked;
    r.volumetric_strain = (approach(w.platens) - in.approach_zero) / w.body.height;  // dilation is negative
    r.mismatch = mismatch(w.platens);
    return r;
  }
  r.platen_strain = in.sign * (approach(w.platens) - in.approach_zero) / in.free_length;
  r.axial_strain =
      in.axial.rows.empty() ? r.platen_strain : in.sign * (gauge_now(w, in.axial) - in.axial_zero);
  r.radial_strain =
      in.lateral.rows.empty() ? CurveRow::untracked : in.sign * (gauge_now(w, in.lateral) - in.lateral_zero);
  r.axial_stress = in.sign * axial_stress(w.platens);
  // across a disc strains are not uniform: no volume follows from them
  r.volumetric_strain = in.grip == Grip::strips ? CurveRow::untracked
                                                : r.axial_strain + in.lateral_directions * r.radial_strain;
  r.mismatch = mismatch(w.platens);
  return r;
}

/// Broken bonds and energies at the end of a row.
CurveRow state_row(World& w) {
  const Lap lap(w.phases, Phase::measure);
  settle(w);
  CurveRow row;
  const BrokenCount broken = count_broken(w);
  row.broken_tension = static_cast<double>(broken.tension);
  row.broken_shear = static_cast<double>(broken.shear);
  row.kinetic_J = kinetic_energy(w);
  if (w.ledger.enabled) {
    const EnergyBalance energies = balance(w);
    note_balance(w.ledger, energies);
    row.stored_J = energies.stored;
    row.dissipated_J = energies.dissipated();
    row.work_J = energies.work;
  } else {
    row.stored_J = stored_energy(w);
  }
  row.confining_stress_Pa = w.confinement.pressure;
  return row;
}

/// Tells a program how far a run is, a few times a second, and what has cracked.
class Teller {
public:
  explicit Teller(const LoadHooks& hooks) : hooks_(hooks) {}
  void tell(int stage, double fraction, const CurveRow& row) {
    const auto now = Clock::now();
    if (!hooks_.progress || now - last_ < std::chrono::milliseconds(100)) return;
    last_ = now;
    hooks_.progress(stage, fraction, row);
  }
  void tell_cracks(World& w, const CurveRow& row) {
    const auto& cracks = w.cracks.cracks;
    if (!hooks_.cracks || cracks.size() == told_) return;
    const Lap lap(w.phases, Phase::output);
    hooks_.cracks(std::span(cracks).subspan(told_), row);
    told_ = cracks.size();
  }

private:
  const LoadHooks& hooks_;
  Clock::time_point last_{};
  std::size_t told_ = 0;
};

/// Pictures of the state, evenly spaced over the run.
class Photographer {
public:
  Photographer(const LoadTest& test, const LoadHooks& hooks) : frames_(test.frames), hooks_(hooks) {}
  void frame_if_due(World& w, double done, const CurveRow& row, bool last) {
    if (frames_ <= 0 || !hooks_.frame || (!last && done * frames_ < taken_)) return;
    const Lap lap(w.phases, Phase::output);
    hooks_.frame(w, row);
    ++taken_;
  }

private:
  int frames_, taken_ = 0;
  const LoadHooks& hooks_;
};

/// What a run needs at hand.
struct Run {
  World& w;
  const Assembly& assembly;
  const LoadTest& test;
  const LoadHooks& hooks;
  LoadResult& result;
  Teller teller;
  Photographer photographer;
  Guards guards;

  bool interrupted() const { return hooks.interrupted && hooks.interrupted(); }
};

/// The pressure on the mantle and on the platens; a shear box has it on its lid alone.
void set_pressure(const Run& run, double pressure) {
  run.w.platens.pressure = pressure;
  if (run.test.loading != Loading::shear) run.w.confinement.pressure = pressure;
}

/// Stage 1: the pressure rises until the specimen rests under it.
/// @returns false when interrupted
bool press_hydrostatically(Run& run) {
  World& w = run.w;
  const double pressure = run.test.confinement, crossing = crossing_time(w, run.assembly);
  const double rise = 16.0 * crossing, patience = 400.0 * crossing;
  w.platens.servo = true;
  double stress = 0.0;  // mean since the last check
  constexpr int between_checks = 50;
  const double start = w.time;
  for (int k = 1;; ++k) {
    set_pressure(run, pressure * eased(w.time - start, rise));
    advance(w);
    ++run.result.stage1_steps;
    stress += axial_stress(w.platens) / between_checks;
    if (k % between_checks != 0) continue;
    CurveRow row = state_row(w);
    check(run.guards, w, row.kinetic_J, row.stored_J);
    row.time_s = w.time;
    row.axial_stress_Pa = stress;
    const double since = w.time - start;
    run.teller.tell(1, std::min(1.0, since / (2.0 * rise)), row);
    run.teller.tell_cracks(w, row);
    if (since > rise && row.kinetic_J < 1e-4 * row.stored_J && std::abs(stress - pressure) < 0.005 * pressure)
      break;
    if (since > patience) {
      run.result.warnings.push_back(
          fmt::format("the specimen did not come to rest under {:.4g} MPa within {:.3g} s: kinetic/stored "
                      "{:.1e}, axial stress {:.4g} MPa",
                      pressure * 1e-6, patience, row.kinetic_J / row.stored_J, stress * 1e-6));
      break;
    }
    if (run.interrupted()) return false;
    stress = 0.0;
  }
  // the lid of a shear box stays under its pressure
  w.platens.servo = run.test.loading == Loading::shear;
  return true;
}

double deviator(const CurveRow& row) { return row.axial_stress_Pa - row.confining_stress_Pa; }

/// Where the platens are going: on, back while the specimen is unloaded, on again.
struct Direction {
  double sense = 1;      ///< -1 while unloading
  std::size_t next = 0;  ///< in unload_at
  double turned_at = 0;  ///< platen strain at which the last unloading began
  double load = 0;       ///< Pa, deviator there

  bool on_envelope(const CurveRow& row) const { return sense > 0.0 && row.platen_strain >= turned_at; }

  void follow(const LoadTest& test, const CurveRow& row, LoadResult& result) {
    if (sense > 0.0 && next < test.unload_at.size() && row.platen_strain >= test.unload_at[next]) {
      sense = -1.0;
      turned_at = row.platen_strain;
      load = deviator(row);
      result.cycles.push_back({row.time_s, 0.0});
    } else if (sense < 0.0 && deviator(row) <= test.unload_to * load) {
      sense = 1.0;
      ++next;
      result.cycles.back().reloaded = row.time_s;
    }
  }
};

/// True when the stress has come down from its peak by the fraction asked for.
bool has_dropped(const Run& run, double& peak, const CurveRow& row) {
  const double strength = run.test.loading == Loading::shear ? row.axial_stress_Pa : deviator(row);
  peak = std::max(peak, strength);
  const double fraction = run.test.stop_after_peak;
  return fraction > 0.0 && strength < (1.0 - fraction) * peak;
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

/// Stage 2: platens at constant speed, after a ramp without a jump.
void load(Run& run) {
  World& w = run.w;
  const LoadTest& test = run.test;
  const Instruments in = instruments_of(w, run.assembly, test);
  const double width = test.loading == Loading::shear ? w.body.diameter : run.assembly.length();
  const double duration = test.stop_strain * width / (2.0 * test.platen_speed);
  const double crossing = crossing_time(w, run.assembly);
  const double ramp = std::max(2.0 * crossing, 0.05 * duration);
  const double start = w.time;
  const auto gone = [&] {
    return test.loading == Loading::shear ? shear_travel(w.platens) - in.shear_zero
                                          : in.sign * (approach(w.platens) - in.approach_zero);
  };
  Recorder& recorder = run.result.record;
  Direction direction;
  double peak = 0.0, speed = 0.0;
  run.photographer.frame_if_due(w, 0.0, CurveRow{}, false);
  while (true) {
    const double wanted = direction.sense * test.platen_speed * eased(w.time - start, ramp);
    // platens that turn back do it within a crossing or two
    speed = test.unload_at.empty() ? wanted : speed + std::min(1.0, w.dt / crossing) * (wanted - speed);
    set_speed(w, test.loading, speed);
    advance(w);
    const double done = gone() / (test.stop_strain * width);
    if (!add_reading(recorder, read(w, in)) && done < 1.0) continue;
    const CurveRow row = close_row(recorder, state_row(w));
    check(run.guards, w, row.kinetic_J, row.stored_J);
    run.teller.tell(2, done, row);
    run.teller.tell_cracks(w, row);
    direction.follow(test, row, run.result);
    const bool dropped = direction.on_envelope(row) && has_dropped(run, peak, row) && w.time - start > ramp;
    const bool interrupted = run.interrupted();
    const bool last = done >= 1.0 || dropped || interrupted;
    run.photographer.frame_if_due(w, done, row, last);
    if (!last) continue;
    run.result.stopped = interrupted ? Stopped::interrupted : dropped ? Stopped::peak_drop : Stopped::strain;
    break;
  }
}

/// The hydrostatic stage as a test of its own: the pressure rises evenly, at the rate at which an elastic
/// specimen between platens of the given speed would take it up.
void press_evenly(Run& run) {
  World& w = run.w;
  const LoadTest& test = run.test;
  const Instruments in = instruments_of(w, run.assembly, test);
  const double rate = w.material.young_modulus * 2.0 * test.platen_speed / run.assembly.length();
  const double duration = test.confinement / rate,
               ramp = std::max(2.0 * crossing_time(w, run.assembly), 0.05 * duration);
  const double start = w.time;
  w.platens.servo = true;
  Recorder& recorder = run.result.record;
  run.photographer.frame_if_due(w, 0.0, CurveRow{}, false);
  double pressure = 0.0;
  while (true) {
    pressure = std::min(test.confinement, pressure + w.dt * rate * eased(w.time - start, ramp));
    set_pressure(run, pressure);
    advance(w);
    const double done = pressure / test.confinement;
    if (!add_reading(recorder, read(w, in)) && done < 1.0) continue;
    const CurveRow row = close_row(recorder, state_row(w));
    check(run.guards, w, row.kinetic_J, row.stored_J);
    run.teller.tell(1, done, row);
    run.teller.tell_cracks(w, row);
    const bool interrupted = run.interrupted(), last = done >= 1.0 || interrupted;
    run.photographer.frame_if_due(w, done, row, last);
    if (!last) continue;
    run.result.stopped = interrupted ? Stopped::interrupted : Stopped::pressure;
    break;
  }
}

}  // namespace

void run_load_test(World& w, const Assembly& assembly, const LoadTest& test, const LoadHooks& hooks,
                   LoadResult& result) {
  const auto start = Clock::now();
  Run run{w, assembly, test, hooks, result, Teller(hooks), Photographer(test, hooks), make_guards(w)};
  if (test.loading == Loading::hydrostatic)
    press_evenly(run);
  else if (test.confinement > 0.0 && !press_hydrostatically(run))
    result.stopped = Stopped::interrupted;
  else
    load(run);
  result.run_time = std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace breccia
