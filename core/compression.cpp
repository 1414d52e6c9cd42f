#include "core/compression.hpp"

#include <chrono>
#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace breccia {
namespace {

using Clock = std::chrono::steady_clock;

/// 0 to 1 without a jump in speed.
double eased(double t, double duration) {
  return t >= duration ? 1.0 : 0.5 * (1.0 - std::cos(std::numbers::pi * t / duration));
}

/// s, for a wave to run from end to end.
double crossing_time(const World& w) {
  return w.body.height / std::sqrt(w.material.young_modulus / w.material.density);
}

double mean_stress(const World& w) { return 0.5 * (w.platens.stress[0] + w.platens.stress[1]); }
double travel(const World& w) { return w.platens.travel[0] + w.platens.travel[1]; }

struct Gauges {
  Gauge axial, radial;
  double axial_zero = 0, radial_zero = 0, travel_zero = 0, free_height = 0;
};

Reading read(World& w, const Gauges& g) {
  const Lap lap(w.phases, Phase::measure);
  Reading r;
  r.time = w.time;
  r.axial_strain = read_gauge(g.axial, w.particles.position, w.particles.reference_position) - g.axial_zero;
  r.radial_strain =
      read_gauge(g.radial, w.particles.position, w.particles.reference_position) - g.radial_zero;
  r.platen_strain = (travel(w) - g.travel_zero) / g.free_height;
  r.axial_stress = mean_stress(w);
  r.mismatch = std::abs(w.platens.stress[1] - w.platens.stress[0]);
  return r;
}

/// Broken bonds, energies and pressure at the end of a row.
CurveRow state_row(World& w) {
  const Lap lap(w.phases, Phase::measure);
  CurveRow row;
  const BrokenCount broken = count_broken(w);
  row.broken_tension = static_cast<double>(broken.tension);
  row.broken_shear = static_cast<double>(broken.shear);
  row.kinetic_J = kinetic_energy(w);
  row.stored_J = stored_energy(w);
  row.confining_stress_Pa = w.confinement.pressure;
  return row;
}

/// When a number is lost: the first particle that has it, and what to try.
void check_finite(const World& w, const CurveRow& row) {
  if (std::isfinite(row.kinetic_J) && std::isfinite(row.stored_J)) return;
  for (std::size_t k = 0; k < w.particles.size; ++k) {
    const Vec3& v = w.particles.velocity[k];
    if (std::isfinite(dot(v, v))) continue;
    fail<SimulationBroke>(
        "at {:.6g} s (step {}) particle {} has a velocity that is not a number; the step may be too "
        "large: try time.safety = {:.2g}",
        w.time, w.step, w.particles.gid[k], 0.5 * w.options.safety);
  }
  fail<SimulationBroke>("at {:.6g} s (step {}) the energy is not a number; try time.safety = {:.2g}", w.time,
                        w.step, 0.5 * w.options.safety);
}

/// Tells a program how far a run is, a few times a second.
class Teller {
public:
  explicit Teller(const CompressionHooks& hooks) : hooks_(hooks) {}
  void tell(int stage, double fraction, const CurveRow& row) {
    const auto now = Clock::now();
    if (!hooks_.progress || now - last_ < std::chrono::milliseconds(100)) return;
    last_ = now;
    hooks_.progress(stage, fraction, row);
  }

private:
  const CompressionHooks& hooks_;
  Clock::time_point last_{};
};

/// Stage 1: the pressure rises on the mantle and on the platens, until the specimen rests under it.
/// @returns false when interrupted
bool press_hydrostatically(World& w, double pressure, Teller& teller, const CompressionHooks& hooks,
                           CompressionResult& result) {
  const double rise = 16.0 * crossing_time(w), patience = 400.0 * crossing_time(w);
  w.platens.servo = true;
  double stress = 0.0;  // mean since the last check
  constexpr int between_checks = 50;
  const double start = w.time;
  for (int k = 1;; ++k) {
    w.confinement.pressure = w.platens.pressure = pressure * eased(w.time - start, rise);
    advance(w);
    ++result.stage1_steps;
    stress += mean_stress(w) / between_checks;
    if (k % between_checks != 0) continue;
    CurveRow row = state_row(w);
    check_finite(w, row);
    row.time_s = w.time;
    row.axial_stress_Pa = stress;
    const double since = w.time - start;
    teller.tell(1, std::min(1.0, since / (2.0 * rise)), row);
    if (since > rise && row.kinetic_J < 1e-4 * row.stored_J && std::abs(stress - pressure) < 0.005 * pressure)
      break;
    if (since > patience) {
      result.warnings.push_back(
          fmt::format("the specimen did not come to rest under {:.4g} MPa within {:.3g} s: kinetic/stored "
                      "{:.1e}, axial stress {:.4g} MPa",
                      pressure * 1e-6, patience, row.kinetic_J / row.stored_J, stress * 1e-6));
      break;
    }
    if (hooks.interrupted && hooks.interrupted()) return false;
    stress = 0.0;
  }
  w.platens.servo = false;
  return true;
}

/// True when the deviator has come down from its peak by the fraction asked for.
bool has_dropped(const std::vector<CurveRow>& rows, double& peak, double fraction) {
  const double deviator = rows.back().axial_stress_Pa - rows.back().confining_stress_Pa;
  peak = std::max(peak, deviator);
  return fraction > 0.0 && deviator < (1.0 - fraction) * peak;
}

void load_axially(World& w, const Assembly& assembly, const CompressionTest& test, Teller& teller,
                  const CompressionHooks& hooks, CompressionResult& result) {
  Gauges g{axial_gauge(assembly), radial_gauge(assembly)};
  g.axial_zero = read_gauge(g.axial, w.particles.position, w.particles.reference_position);
  g.radial_zero = read_gauge(g.radial, w.particles.position, w.particles.reference_position);
  g.travel_zero = travel(w);
  g.free_height = assembly.body.height - 2.0 * assembly.layer;

  const double height = assembly.body.height;
  const double duration = test.stop_strain * height / (2.0 * test.platen_speed);
  const double ramp = std::max(2.0 * crossing_time(w), 0.05 * duration);
  const double start = w.time;
  Recorder& recorder = result.record;
  double peak = 0.0;
  int frames = 0;
  const auto frame_if_due = [&](double done, const CurveRow& row, bool last) {
    if (test.frames <= 0 || !hooks.frame) return;
    if (!last && done * test.frames < frames) return;
    const Lap lap(w.phases, Phase::output);
    hooks.frame(w, row);
    ++frames;
  };
  frame_if_due(0.0, CurveRow{}, false);
  while (true) {
    const double speed = test.platen_speed * eased(w.time - start, ramp);
    w.platens.velocity = {speed, -speed};
    advance(w);
    const double done = (travel(w) - g.travel_zero) / (test.stop_strain * height);
    if (!add_reading(recorder, read(w, g)) && done < 1.0) continue;
    const CurveRow row = close_row(recorder, state_row(w));
    check_finite(w, row);
    teller.tell(2, done, row);
    const bool dropped = has_dropped(recorder.rows, peak, test.stop_after_peak) && w.time - start > ramp;
    const bool interrupted = hooks.interrupted && hooks.interrupted();
    const bool last = done >= 1.0 || dropped || interrupted;
    frame_if_due(done, row, last);
    if (!last) continue;
    result.stopped = interrupted ? Stopped::interrupted : dropped ? Stopped::peak_drop : Stopped::strain;
    break;
  }
}

}  // namespace

void run_compression(World& w, const Assembly& assembly, const CompressionTest& test,
                     const CompressionHooks& hooks, CompressionResult& result) {
  const auto start = Clock::now();
  Teller teller(hooks);
  if (test.confinement > 0.0 && !press_hydrostatically(w, test.confinement, teller, hooks, result))
    result.stopped = Stopped::interrupted;
  else
    load_axially(w, assembly, test, teller, hooks, result);
  result.run_time = std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace breccia
