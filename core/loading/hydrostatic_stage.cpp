#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/fields/stress.hpp"
#include "core/loading/stages.hpp"
#include "core/stepping/step.hpp"
#include "core/world/energies.hpp"
#include "core/world/sync.hpp"

namespace breccia {
namespace {

/// Whether platens that are about to be stopped move at a tenth of the test's speed at most.
bool is_slow(const Run& run) {
  if (run.test.loading == Loading::shear) return true;  // a lid goes on under its pressure
  const auto& v = run.w.platens.velocity;
  return std::max(std::abs(v[0].z), std::abs(v[1].z)) < 0.1 * run.test.platen_speed;
}

/// What stage 1 did to the bonds.
void count_yielded(Run& run) {
  World& w = run.w;
  sync(w);
  const BrokenCount broken = count_broken(w);
  run.result.stage1_broken = broken.tension + broken.shear;
  std::vector<std::uint64_t> blocks;
  if (!w.features.plasticity) return;
  run.result.stage1_yielded = sum_pairs(w.partition, w.bonds, w.options.threads, blocks, [&](std::size_t k) {
    return std::uint64_t{w.bonds.plastic_stretch[k] < 0.0};
  });
}

}  // namespace

bool press_hydrostatically(Run& run) {
  World& w = run.w;
  const double pressure = axial_start(run.test), crossing = crossing_time(w, run.assembly);
  const double rise = 16.0 * crossing, patience = 400.0 * crossing;  // (B67)
  w.platens.servo = true;
  if (run.test.loading != Loading::shear) w.platens.rough = false;  // (B110)
  double stress = 0.0;                                              // mean since the last check
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
    // The dashpot takes up what is missing of the pressure, so that half a per cent of a large one
    // leaves the platens nearly as fast as the test's (concrete at 100 MPa: 0.06 m/s). Stopped dead
    // they would send a wave into the specimen, and the deviator would begin below zero. What has
    // come loose flies or rattles on, and has no say in whether the specimen rests.
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
  count_yielded(run);
  // the lid of a shear box stays under its pressure
  w.platens.servo = run.test.loading == Loading::shear;
  return true;
}

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

}  // namespace breccia
