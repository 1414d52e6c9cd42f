#include "drivers/studies/stability/results.hpp"

#include <fmt/format.h>

#include <cmath>

#include "drivers/studies/study_json.hpp"
#include "io/files/atomic_write.hpp"

namespace breccia {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no word for what is not a number, and none for infinity.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json values_of(const StabilityRun& r) {
  return {{"scene", r.scene},
          {"part", name_of(r.part)},
          {"fraction", r.fraction},
          {"verdict", name_of(r.verdict)},
          {"spheres", r.spheres},
          {"bonds", r.bonds},
          {"steps", r.steps},
          {"time_step_s", number(r.dt)},
          {"limit_s", number(r.exact_dt)},
          {"estimate_over_limit", number(r.estimate_dt / r.exact_dt)},
          {"energy_error", number(r.energy_error)},
          {"drift", number(r.drift)},
          {"broken_bonds", number(r.broken)},
          {"peak_stress_Pa", number(r.peak)},
          {"peak_change", number(r.peak_change)},
          {"amiss", is_amiss(r)},
          {"cause", r.cause}};
}

}  // namespace

void write_stability_csv(const std::filesystem::path& file, const StabilityResults& results) {
  std::vector<Json> rows;
  for (const auto& runs : results.parts)
    for (const StabilityRun& r : runs) rows.push_back(values_of(r));
  atomic_write(file, csv_of(rows));
}

void write_stability_json(const std::filesystem::path& file, const StabilityResults& results) {
  Json runs = Json::array();
  for (const auto& part : results.parts)
    for (const StabilityRun& r : part) runs.emplace_back(values_of(r))["stresses"] = r.stresses;
  const Json all{{"study", "stability"},
                 {"version", results.machine.version},
                 {"machine", json_of(results.machine)},
                 {"test",
                  {{"material", results.material},
                   {"network_steps", results.length.network_steps},
                   {"precision", name_of(results.length.precision)}}},
                 {"runs", runs}};
  atomic_write(file, all.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
}

}  // namespace breccia
