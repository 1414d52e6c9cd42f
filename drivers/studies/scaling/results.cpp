#include "drivers/studies/scaling/results.hpp"

#include <fmt/format.h>

#include "drivers/studies/published_times.hpp"
#include "drivers/studies/study_json.hpp"
#include "io/files/atomic_write.hpp"

namespace breccia {
namespace {

using Json = nlohmann::ordered_json;

/// What a run comes to: names and values, the same in both files. Shares are of the wall time of
/// the blocks.
Json values_of(const ScalingRun& run, const std::vector<ScalingRun>& runs) {
  const MedianAndRange t = step_time(run);
  const ScalingGain gain = gain_of(run, runs);
  Json values{{"study", name_of(run.point.study)},
              {"precision", name_of(run.point.precision)},
              {"scatter", name_of(run.point.scatter)},
              {"ranks", run.ranks},
              {"threads", run.point.threads},
              {"spheres", run.point.spheres},
              {"bonds", run.bonds},
              {"broken_bonds", run.broken},
              {"steps", run.steps},
              {"repeats", run.seconds.size()},
              {"step_median_s", t.median},
              {"step_least_s", t.least},
              {"step_most_s", t.most},
              {"ns_per_bond", 1e9 * t.median / static_cast<double>(run.bonds)},
              {"bond_updates_per_s", bond_updates(run)},
              {"speed_up", gain.speed_up},
              {"efficiency", gain.efficiency},
              {"halo_rows", run.halo_rows},
              {"imbalance", run.imbalance}};
  for (std::size_t k = 0; k < phase_names.size(); ++k)
    values[fmt::format("share_{}", phase_names[k])] = run.phases.seconds[k] / run.all_seconds();
  values["share_other"] = 1.0 - run.phases.total() / run.all_seconds();
  values["table_bytes_per_bond"] = table_bytes_per_bond(run);
  values["peak_rss_bytes"] = run.peak_bytes;
  return values;
}

Json test_of(const ScalingResults& r) {
  return {{"test", "ucs"},
          {"material", r.material},
          {"law", "dempack"},
          {"diameter_m", scaling_body.diameter},
          {"height_m", scaling_body.height},
          {"platen_speed_m_s", scaling_speed},
          {"alpha", "affine"},
          {"warm_up_steps", r.blocks.warm_up},
          {"steps_per_row", ScalingBlocks::steps_per_row}};
}

Json of(const PublishedTimes& p) {
  return {{"code", p.code},       {"parallel", p.parallel}, {"source", p.source},
          {"machine", p.machine}, {"note", p.note},         {"spheres", p.spheres},
          {"steps", p.steps},     {"cores", p.cores},       {"time_s", p.seconds}};
}

}  // namespace

void write_scaling_csv(const std::filesystem::path& file, const ScalingResults& results) {
  std::vector<Json> rows;
  for (const ScalingRun& run : results.runs) rows.push_back(values_of(run, results.runs));
  atomic_write(file, csv_of(rows));
}

void write_scaling_json(const std::filesystem::path& file, const ScalingResults& results) {
  Json runs = Json::array(), published = Json::array();
  for (const ScalingRun& run : results.runs) {
    Json& values = runs.emplace_back(values_of(run, results.runs));
    values["block_s"] = run.seconds;
    for (std::size_t k = 0; k < phase_names.size(); ++k)
      values["phases_s"][std::string(phase_names[k])] = run.phases.seconds[k];
    values["alpha"] = run.alpha;
    values["time_step_s"] = run.time_step;
    values["table_bytes"] = run.table_bytes;
    values["state_hash"] = run.state_hash;
  }
  for (const PublishedTimes& p : published_times()) published.push_back(of(p));
  const Json all{{"study", "scaling"},
                 {"version", results.machine.version},
                 {"machine", json_of(results.machine)},
                 {"test", test_of(results)},
                 {"runs", runs},
                 {"published", published}};
  atomic_write(file, all.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
}

}  // namespace breccia
