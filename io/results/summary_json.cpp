#include "io/results/summary_json.hpp"

#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/error.hpp"
#include "io/files/atomic_write.hpp"
#include "io/text/input_file.hpp"

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

/// The fields of a run in the order in which they are explained: what is written and what is read
/// back.
template <class Run, class Visit>
void for_each_field(Run& run, Visit&& visit) {
  visit("confinement_Pa", run.confinement_Pa);
  visit("confinement_measured_Pa", run.confinement_measured_Pa);
  visit("peak_stress_Pa", run.peak_stress_Pa);
  visit("peak_deviator_Pa", run.peak_deviator_Pa);
  visit("peak_reached", run.peak_reached);
  visit("strain_at_peak", run.strain_at_peak);
  visit("young_modulus_Pa", run.young_modulus_Pa);
  visit("young_modulus_50_Pa", run.young_modulus_50_Pa);
  visit("poisson_ratio", run.poisson_ratio);
  visit("crack_initiation_stress_Pa", run.crack_initiation_stress_Pa);
  visit("crack_damage_stress_Pa", run.crack_damage_stress_Pa);
  visit("tensile_strength_Pa", run.tensile_strength_Pa);
  visit("alpha", run.alpha);
  visit("alpha_affine", run.alpha_affine);
  visit("mantle_cover", run.mantle_cover);
  visit("particles", run.particles);
  visit("loose_particles", run.loose_particles);
  visit("pieces", run.pieces);
  visit("bonds", run.bonds);
  visit("coordination", run.coordination);
  visit("dropped_bonds", run.dropped_bonds);
  visit("short_bonds", run.short_bonds);
  visit("broken_tension", run.broken_tension);
  visit("broken_shear", run.broken_shear);
  visit("localisation", run.localisation);
  visit("contact_searches", run.contact_searches);
  visit("length_quantum_m", run.length_quantum_m);
  visit("force_quantum_N", run.force_quantum_N);
  visit("steps", run.steps);
  visit("time_step_s", run.time_step_s);
  visit("lowest_time_step_s", run.lowest_time_step_s);
  visit("critical_time_step_s", run.critical_time_step_s);
  visit("step_estimates", run.step_estimates);
  visit("local_step_estimates", run.local_step_estimates);
  visit("mass_factor", run.mass_factor);
  visit("scaled_particles", run.scaled_particles);
  visit("run_time_s", run.run_time_s);
  visit("phases_s", run.phases_s);
  visit("bond_updates_per_s", run.bond_updates_per_s);
  visit("bond_pass_per_s", run.bond_pass_per_s);
  visit("energy_error", run.energy_error);
  visit("rate_error", run.rate_error);
  visit("step_error", run.step_error);
  visit("sampling_error", run.sampling_error);
  visit("kinetic_ratio", run.kinetic_ratio);
  visit("platen_mismatch", run.platen_mismatch);
  visit("state_hash", run.state_hash);
  visit("stopped_by", run.stopped_by);
  visit("warnings", run.warnings);
}

/// What only some tests measure: keys that are absent elsewhere.
template <class Run, class Visit>
void for_each_rare_field(Run& run, Visit&& visit) {
  visit("strip_corrected_strength_Pa", run.strip_corrected_strength_Pa);
  visit("first_drop_stress_Pa", run.first_drop_stress_Pa);
  visit("first_cracks", run.first_cracks);
  visit("bulk_modulus_Pa", run.bulk_modulus_Pa);
  visit("cycles", run.cycles);
  visit("confining_stress_at_peak_Pa", run.confining_stress_at_peak_Pa);
  visit("intermediate_stress_Pa", run.intermediate_stress_Pa);
  visit("cutting_force_N", run.cutting_force_N);
  visit("thrust_N", run.thrust_N);
  visit("largest_cutting_force_N", run.largest_cutting_force_N);
  visit("specific_energy_J_per_m3", run.specific_energy_J_per_m3);
  visit("hydrostatic_branch", run.hydrostatic_branch);
  visit("limits_raised_Pa", run.limits_raised_Pa);
  visit("stage1_broken", run.stage1_broken);
  visit("stage1_yielded", run.stage1_yielded);
  visit("material_values", run.material_values);
  visit("material_spheres", run.material_spheres);
  visit("material_broken", run.material_broken);
  visit("files", run.files);
}

using Seconds = std::vector<std::pair<std::string, double>>;
using Digests = std::vector<std::pair<std::string, std::string>>;

Json of(const Digests& files) {
  Json all = Json::object();
  for (const auto& [name, digest] : files) all[name] = digest;
  return all;
}

Json of(const Seconds& phases) {
  Json all = Json::object();
  for (const auto& [name, seconds] : phases) all[name] = seconds;
  return all;
}
Json of(const std::vector<CycleSummary>& cycles) {
  Json all = Json::array();
  for (const CycleSummary& cycle : cycles) all.push_back(of(cycle));
  return all;
}
template <class T>
Json of(const T& value) {
  return value;
}

bool is_absent(const std::optional<double>& value) { return !value; }
template <class T>
bool is_absent(const T& value) {
  return value.empty();
}

Json of(const RunSummary& run) {
  Json all = Json::object();
  for_each_field(run, [&](const char* key, const auto& value) { all[key] = of(value); });
  for_each_rare_field(run, [&](const char* key, const auto& value) {
    if (!is_absent(value)) all[key] = of(value);
  });
  return all;
}

// A number that was not finite comes back as one that is none.
void take(const Json& json, double& value) {
  value = json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}
void take(const Json& json, std::optional<double>& value) {
  value = json.is_null() ? std::nullopt : std::optional(json.get<double>());
}
void take(const Json& json, Seconds& phases) {
  for (const auto& [name, seconds] : json.items()) phases.emplace_back(name, seconds.get<double>());
}
void take(const Json& json, Digests& files) {
  for (const auto& [name, digest] : json.items()) files.emplace_back(name, digest.get<std::string>());
}
void take(const Json& json, std::vector<CycleSummary>& cycles) {
  for (const Json& one : json) {
    CycleSummary& cycle = cycles.emplace_back();
    take(one.at("strain"), cycle.strain);
    take(one.at("permanent_strain"), cycle.permanent_strain);
    take(one.at("unloading_modulus_Pa"), cycle.unloading_modulus_Pa);
    take(one.at("reloading_modulus_Pa"), cycle.reloading_modulus_Pa);
  }
}
template <class T>
void take(const Json& json, T& value) {
  value = json.get<T>();
}

RunSummary run_of(const Json& json) {
  RunSummary run;
  for_each_field(run, [&](const char* key, auto& value) { take(json.at(key), value); });
  for_each_rare_field(run, [&](const char* key, auto& value) {
    if (json.contains(key)) take(json.at(key), value);
  });
  return run;
}

Json of(const MohrCoulomb& line) {
  return {{"cohesion_Pa", line.cohesion_Pa},
          {"friction_angle_deg", line.friction_angle_deg},
          {"residual_Pa", line.residual_Pa},
          {"peaks", line.peaks}};
}

}  // namespace

std::string runs_text(const std::vector<RunSummary>& runs) {
  Json all = Json::array();
  for (const RunSummary& run : runs) all.push_back(of(run));
  return all.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::vector<RunSummary> read_runs(const std::string& text) {
  std::vector<RunSummary> runs;
  try {
    for (const Json& json : Json::parse(text)) runs.push_back(run_of(json));
  } catch (const Json::exception& other) {
    fail<BadInput>(
        "the summary of the runs before is that of another version of breccia ({}); run anew with --force",
        other.what());
  }
  return runs;
}

FinishedRuns finished_runs(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return {};
  try {
    FinishedRuns finished;
    const Json all = Json::parse(read_bytes(file));
    for (const Json& run : all.at("runs")) {
      if (run.at("stopped_by") == "interrupted") continue;
      ++finished.count;
      if (run.contains("files")) take(run.at("files"), finished.files);
    }
    return finished;
  } catch (const Json::exception&) {
    fail<BadInput>("{}: damaged, and there is no checkpoint; put it back as it was, or run anew with --force",
                   file.string());
  }
}

void write_summary(const std::filesystem::path& file, const SeriesSummary& series) {
  Json runs = Json::array();
  for (const RunSummary& run : series.runs) runs.push_back(of(run));
  Json all{{"test", series.test},
           {"version", series.version},
           {"threads", series.threads},
           {"ranks", series.ranks}};
  if (!series.inputs.empty()) all["inputs"] = of(series.inputs);
  if (series.mohr_coulomb) all["mohr_coulomb"] = of(*series.mohr_coulomb);
  if (!series.no_mohr_coulomb.empty()) all["no_mohr_coulomb"] = series.no_mohr_coulomb;
  all["runs"] = std::move(runs);
  // replace: a text that is not UTF-8 (a file's name) must not lose the results of hours
  atomic_write(file, all.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
}

}  // namespace breccia
