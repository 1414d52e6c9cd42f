#include "core/loading/stages.hpp"

#include <cmath>
#include <numbers>

#include "core/base/hold.hpp"
#include "core/boundary/loose_surface.hpp"
#include "core/distributed/gather.hpp"
#include "core/distributed/halo.hpp"
#include "core/world/energies.hpp"
#include "core/world/energy_accounting.hpp"
#include "core/world/sync.hpp"

namespace breccia {

using Clock = std::chrono::steady_clock;

double eased(double t, double duration) {
  return t >= duration ? 1.0 : 0.5 * (1.0 - std::cos(std::numbers::pi * t / duration));
}

double crossing_time(const World& w, const Assembly& a) {
  return a.length() / std::sqrt(w.material.young_modulus / w.material.density);
}

CurveRow state_row(World& w) {
  finish_halo_exchange(w);
  const Lap lap(w.phases, Phase::measure);
  const bool quick = w.laws.size() == 1 && !w.features.unloading;  // see stored_energy
  quick ? sync_damaged(w) : sync(w);
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
  if (!std::isfinite(row.stored_J)) sync(w);  // somebody will look for the bond
  row.confining_stress_Pa = w.confinement.acting;
  return row;
}

void enter(Run& run, Stage stage) {
  run.state.stage = stage;
  run.state.stage_start = run.w.time;
}

void note_run_time(Run& run) {
  run.result.run_time = run.run_time_before + std::chrono::duration<double>(Clock::now() - run.begun).count();
}

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

void frame_if_due(Run& run, double done, const CurveRow& row, bool last) {
  const int frames = run.test.frames;
  if (frames <= 0) return;
  if (!last && done * frames < static_cast<double>(run.state.frames)) return;
  const Lap lap(run.w.phases, Phase::output);
  if (run.hooks.frame) run.hooks.frame(run.w, run.state.frames, row);
  ++run.state.frames;
  if (run.is_root()) hold_at(HoldPoint::frame);
}

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

void set_pressure(const Run& run, double pressure) {
  run.w.platens.pressure = pressure;
  if (run.test.loading == Loading::shear) return;
  // those of a box rise together (B121)
  run.w.confinement.pressure_x = pressure;
  run.w.confinement.pressure = pressure * (run.test.confinement / axial_start(run.test));
}

Instruments begin_or_go_on(Run& run, Stage stage) {
  const bool resumed = run.state.stage == stage;
  if (!resumed) run.state.left_out = loose_at_surface(run.w);
  const Instruments in = make_instruments(run.w, run.assembly, run.test, run.state.left_out,
                                          resumed ? &run.state.zeros : nullptr);
  run.w.watch = watch_of(in.axial, in.lateral, run.w.particles.reference_position, run.w.partition);
  if (resumed) return in;
  enter(run, stage);
  run.state.zeros = in.zeros;
  frame_if_due(run, 0.0, CurveRow{}, false);
  return in;
}

}  // namespace breccia
