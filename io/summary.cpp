#include "io/summary.hpp"

#include <nlohmann/json.hpp>

#include "io/write_aside.hpp"

namespace breccia {
namespace {

using Json = nlohmann::ordered_json;  // keys stay in the order in which they are explained

Json of(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json of(const CycleSummary& cycle) {
  return {{"strain", cycle.strain},
          {"permanent_strain", cycle.permanent_strain},
          {"unloading_modulus_Pa", cycle.unloading_modulus_Pa},
          {"reloading_modulus_Pa", cycle.reloading_modulus_Pa}};
}

Json of(const RunSummary& run) {
  Json phases = Json::object();
  for (const auto& [name, seconds] : run.phases_s) phases[name] = seconds;
  Json all{
      {"confinement_Pa", run.confinement_Pa},
      {"peak_stress_Pa", of(run.peak_stress_Pa)},
      {"peak_deviator_Pa", of(run.peak_deviator_Pa)},
      {"peak_reached", run.peak_reached},
      {"strain_at_peak", of(run.strain_at_peak)},
      {"young_modulus_Pa", of(run.young_modulus_Pa)},
      {"young_modulus_50_Pa", of(run.young_modulus_50_Pa)},
      {"poisson_ratio", of(run.poisson_ratio)},
      {"crack_initiation_stress_Pa", of(run.crack_initiation_stress_Pa)},
      {"crack_damage_stress_Pa", of(run.crack_damage_stress_Pa)},
      {"tensile_strength_Pa", of(run.tensile_strength_Pa)},
      {"alpha", of(run.alpha)},
      {"particles", run.particles},
      {"bonds", run.bonds},
      {"coordination", run.coordination},
      {"dropped_bonds", run.dropped_bonds},
      {"short_bonds", run.short_bonds},
      {"broken_tension", run.broken_tension},
      {"broken_shear", run.broken_shear},
      {"steps", run.steps},
      {"time_step_s", run.time_step_s},
      {"lowest_time_step_s", run.lowest_time_step_s},
      {"critical_time_step_s", of(run.critical_time_step_s)},
      {"step_estimates", run.step_estimates},
      {"mass_factor", run.mass_factor},
      {"scaled_particles", run.scaled_particles},
      {"run_time_s", run.run_time_s},
      {"phases_s", phases},
      {"bond_updates_per_s", of(run.bond_updates_per_s)},
      {"bond_pass_per_s", of(run.bond_pass_per_s)},
      {"energy_error", of(run.energy_error)},
      {"rate_error", of(run.rate_error)},
      {"step_error", of(run.step_error)},
      {"sampling_error", of(run.sampling_error)},
      {"kinetic_ratio", of(run.kinetic_ratio)},
      {"platen_mismatch", of(run.platen_mismatch)},
      {"state_hash", run.state_hash},
      {"stopped_by", run.stopped_by},
      {"warnings", run.warnings},
  };
  // what only some tests measure
  if (run.strip_corrected_strength_Pa) all["strip_corrected_strength_Pa"] = *run.strip_corrected_strength_Pa;
  if (run.first_drop_stress_Pa) all["first_drop_stress_Pa"] = *run.first_drop_stress_Pa;
  if (!run.first_cracks.empty()) all["first_cracks"] = run.first_cracks;
  if (run.bulk_modulus_Pa) all["bulk_modulus_Pa"] = *run.bulk_modulus_Pa;
  if (!run.cycles.empty()) {
    all["cycles"] = Json::array();
    for (const CycleSummary& cycle : run.cycles) all["cycles"].push_back(of(cycle));
  }
  return all;
}

Json of(const MohrCoulomb& line) {
  return {{"cohesion_Pa", line.cohesion_Pa},
          {"friction_angle_deg", line.friction_angle_deg},
          {"residual_Pa", line.residual_Pa},
          {"peaks", line.peaks}};
}

}  // namespace

void write_summary(const std::filesystem::path& file, const SeriesSummary& series) {
  Json runs = Json::array();
  for (const RunSummary& run : series.runs) runs.push_back(of(run));
  Json all{{"test", series.test},
           {"version", series.version},
           {"threads", series.threads},
           {"ranks", series.ranks}};
  if (series.mohr_coulomb) all["mohr_coulomb"] = of(*series.mohr_coulomb);
  all["runs"] = std::move(runs);
  // replace: a text that is not UTF-8 (a file's name) must not lose the results of hours
  write_aside(file, all.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
}

}  // namespace breccia
