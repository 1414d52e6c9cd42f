// All that a run must remember beside its tables to go on as if it had never stopped: one list,
// which the writer and the reader of checkpoints walk alike, so that neither can forget what the
// other keeps. What is made anew from the case (laws, masses, plans) and what the next step works
// out for itself is not in it.
#pragma once
#include "core/loading/load_test.hpp"
#include "core/world/world.hpp"

namespace breccia {

/// Calls visit(name, value) for each; values are numbers, arrays of numbers, and vectors of either.
/// @param w  World or const World
template <class W, class Visit>
void for_each_number_of_world(W& w, Visit&& visit) {
  visit("time", w.time);
  visit("step", w.step);
  visit("dt", w.dt);
  visit("critical_dt", w.critical_dt);
  visit("phases", w.phases.seconds);

  visit("single_motion", w.single.quanta.motion);
  visit("single_force", w.single.quanta.force);
  visit("single_events", w.single.events);
  visit("single_renewals", w.single.renewals);
  visit("single_coarsenings", w.single.coarsenings);

  visit("platens_servo", w.platens.servo);
  visit("platens_pressure", w.platens.pressure);
  visit("platens_velocity", w.platens.velocity);
  visit("platens_travel", w.platens.travel);
  visit("platens_force", w.platens.force);
  visit("platens_work", w.platens.work);
  visit("tool_travel", w.tool.travel);
  visit("tool_work", w.tool.work);
  visit("confinement_pressure", w.confinement.pressure);
  visit("confinement_pressure_x", w.confinement.pressure_x);
  visit("confinement_grown", w.confinement.grown);

  visit("search_awake", w.neighbour_list.awake);
  visit("search_slack", w.neighbour_list.slack);
  visit("search_next_check", w.neighbour_list.next_check);
  visit("search_rebuilds", w.neighbour_list.rebuilds);
  visit("search_next", w.neighbour_list.next_search);

  visit("step_room", w.step_monitor.margin);
  visit("step_counted", w.step_monitor.counted);
  visit("step_local_looks", w.step_monitor.local_looks);
  visit("step_looks", w.step_monitor.looks);
  visit("step_first_dt", w.step_monitor.first_dt);

  visit("cracks", w.cracks.cracks);
  visit("cracks_collected", w.cracks.collected);
  visit("cracks_missed", w.cracks.missed);

  if (!w.ledger.enabled) return;
  visit("ledger_bonds", w.ledger.bonds);
  visit("ledger_contacts", w.ledger.contacts);
  visit("ledger_own_bonds", w.ledger.owned_bonds);
  visit("ledger_own_contacts", w.ledger.owned_contacts);
  visit("ledger_earlier_contacts", w.ledger.earlier_contacts);
  visit("ledger_platens", w.ledger.platens);
  visit("ledger_pressure", w.ledger.pressure);
  visit("ledger_walls", w.ledger.walls);
  visit("ledger_damped_motion", w.ledger.damped_motion);
  visit("ledger_damped_spin", w.ledger.damped_spin);
  visit("ledger_kinetic", w.ledger.kinetic);
  visit("ledger_start", w.ledger.start);
  visit("ledger_most_work", w.ledger.most_work);
  visit("ledger_worst_balance", w.ledger.worst_balance);
  visit("ledger_worst_loss", w.ledger.worst_loss);
}

/// The same for the test that a world is in: where it stands, what it has recorded, what its guards
/// remember.
template <class S, class R, class Visit>
void for_each_number_of_test(S& state, R& result, Visit&& visit) {
  visit("stage", state.stage);
  visit("stage_start", state.stage_start);
  visit("pressure", state.pressure);
  visit("speed", state.speed);
  visit("peak", state.peak);
  visit("zeros", state.zeros);
  visit("left_out", state.left_out);
  visit("direction", state.direction);
  visit("next_unloading", state.next_unloading);
  visit("frames", state.frames);
  visit("cracks_told", state.cracks_told);

  visit("checks_centre", state.checks.centre);
  visit("checks_size", state.checks.size);
  visit("checks_farthest", state.checks.farthest);
  visit("checks_fastest", state.checks.fastest);
  visit("checks_shortest", state.checks.shortest);
  visit("checks_accounted", state.checks.accounted);
  visit("checks_max_energy", state.checks.max_energy);
  visit("checks_noise", state.checks.noise);
  visit("checks_platen_work", state.checks.platen_work);
  visit("checks_lateral", state.checks.lateral);
  visit("checks_push", state.checks.push);

  visit("rows", result.record.rows);
  visit("mismatch", result.record.mismatch);
  visit("steps_per_row", result.record.steps_per_row);
  visit("cycles", result.cycles);
  visit("stage1_steps", result.stage1_steps);
  visit("stage1_broken", result.stage1_broken);
  visit("stage1_yielded", result.stage1_yielded);
  visit("held_pressure", result.held_pressure);
  visit("run_time", result.run_time);
}

}  // namespace breccia
