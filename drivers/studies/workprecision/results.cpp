#include "drivers/studies/workprecision/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "drivers/studies/study_json.hpp"
#include "io/files/atomic_write.hpp"

namespace breccia {
namespace {

using Json = nlohmann::ordered_json;

Json of(const Recipe& r) {
  return {{"step", r.safety},
          {"platen_speed_m_s", r.platen_speed},
          {"scheme", name_of(r.scheme)},
          {"mass_factor", r.mass_factor},
          {"damping_translation", r.damping.translation},
          {"damping_rotation", r.damping.rotation},
          {"precision", name_of(r.precision)},
          {"scatter", name_of(r.scatter)}};
}

Json of(const Errors& errors) {
  Json json;
  for (const Measure m : all_measures) json[std::string(name_of(m))] = errors[static_cast<std::size_t>(m)];
  return json;
}

std::string status_of(const Outcome& o) {
  return !o.failure.empty() ? "broke" : o.peak_reached ? "ok" : "no peak";
}

Json values_of(const WorkPrecisionResults& results, std::size_t k) {
  const auto& [trial, o] = results.runs[k];
  Json values{{"purpose", name_of(trial.purpose)}, {"family", name_of(trial.family)}};
  values.update(of(trial.recipe));
  values.update(Json{{"spheres", o.spheres},
                     {"packing_seed", trial.seed},
                     {"perturbation", trial.shake},
                     {"perturbation_size", trial.shake_size},
                     {"threads", trial.threads},
                     {"timed_alone", trial.timed},
                     {"status", status_of(o)},
                     {"steps", o.steps},
                     {"time_step_s", o.time_step},
                     {"run_time_s", o.run_time},
                     {"peak_deviator_Pa", o.readings.peak},
                     {"young_modulus_Pa", o.readings.young},
                     {"strain_at_peak", o.readings.strain_at_peak}});
  for (const Measure m : all_measures)
    values[fmt::format("error_{}", name_of(m))] =
        results.analysis ? results.analysis->errors[k][static_cast<std::size_t>(m)] : Readings::none;
  values["kinetic_ratio"] = o.kinetic_ratio;
  values["platen_mismatch"] = o.platen_mismatch;
  return values;
}

/// An absent number is an empty field of the table.
Json without_nulls(Json row) {
  for (auto& [name, value] : row.items())
    if (value.is_number_float() && !std::isfinite(value.get<double>())) value = "";
  return row;
}

Json of(const Reference& r) {
  return {{"recipe", of(r.recipe)},           {"runs", r.runs},
          {"peak_reached", r.peak_reached},   {"peak_deviator_Pa", r.mean.peak},
          {"young_modulus_Pa", r.mean.young}, {"strain_at_peak", r.mean.strain_at_peak},
          {"strain", r.mean.curve.strain},    {"stress_Pa", r.mean.curve.stress},
          {"half_step", of(r.half_step)},     {"half_speed", of(r.half_speed)},
          {"error_bar", of(r.bar)},           {"resolution", of(r.resolution)}};
}

Json fronts_of(const Analysis& a) {
  Json json;
  for (const Front& front : a.fronts) json[std::string(name_of(front.measure))] = front.runs;
  return json;
}

Json cheapest_of(const WorkPrecisionResults& results) {
  Json list = Json::array();
  for (const Cheapest& c : results.analysis->cheapest) {
    Json& json = list.emplace_back(Json{{"measure", c.measure ? name_of(*c.measure) : "all"},
                                        {"tolerance", c.tolerance},
                                        {"run", nullptr},
                                        {"case", nullptr}});
    if (!c.run) continue;
    json["run"] = *c.run;
    json["case"] = case_lines(results.runs[*c.run].trial.recipe);
  }
  return list;
}

Json sizes_of(const Analysis& a) {
  Json groups = Json::array(), fits;
  for (const SizeGroup& g : a.sizes)
    groups.push_back({{"spheres", g.spheres},
                      {"seeds", g.seeds},
                      {"mean", of(g.mean)},
                      {"spread", of(g.spread)},
                      {"run_time_s", g.run_time}});
  for (const Measure m : all_measures)
    if (const auto& fit = a.fits[static_cast<std::size_t>(m)])
      fits[std::string(name_of(m))] = {
          {"factor", fit->factor}, {"exponent", fit->exponent}, {"factor_of_root", fit->factor_half}};
  return {{"groups", groups}, {"fits", fits}};
}

}  // namespace

void write_workprecision_csv(const std::filesystem::path& file, const WorkPrecisionResults& results) {
  std::vector<Json> rows;
  for (std::size_t k = 0; k < results.runs.size(); ++k) rows.push_back(without_nulls(values_of(results, k)));
  atomic_write(file, csv_of(rows));
}

void write_workprecision_json(const std::filesystem::path& file, const WorkPrecisionResults& results) {
  Json runs = Json::array();
  for (std::size_t k = 0; k < results.runs.size(); ++k) {
    Json& values = runs.emplace_back(values_of(results, k));
    const Outcome& o = results.runs[k].outcome;
    values["failure"] = o.failure;
    values["critical_time_step_s"] = o.critical_time_step;
    values["bonds"] = o.bonds;
  }
  Json all{{"study", "workprecision"},
           {"version", results.machine.version},
           {"machine", json_of(results.machine)},
           {"case",
            {{"file", results.case_file},
             {"hash", results.case_hash},
             {"test", results.test},
             {"confinement_Pa", results.confinement},
             {"threads", results.threads},
             {"recipe", of(results.base)}}}};
  if (const auto& a = results.analysis) {
    all["reference"] = of(a->reference);
    all["floor"] = of(a->reference.floor);
    all["fronts"] = fronts_of(*a);
    all["cheapest"] = cheapest_of(results);
    all["sizes"] = sizes_of(*a);
    all["warnings"] = a->warnings;
  }
  all["runs"] = runs;
  atomic_write(file, all.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
}

}  // namespace breccia
