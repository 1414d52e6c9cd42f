#include "drivers/studies/layouts/results.hpp"

#include <fmt/format.h>

#include "drivers/studies/study_json.hpp"
#include "io/files/atomic_write.hpp"

namespace breccia {
namespace {

using Json = nlohmann::ordered_json;

/// What a layout comes to: names and values, the same in both files.
Json values_of(const LayoutsGroup& group, const LayoutResult& r) {
  return {{"spheres", group.spheres},
          {"bonds", group.bonds},
          {"threads", group.threads},
          {"precision", name_of(r.layout.precision)},
          {"bond_storage", name_of(r.layout.bonds)},
          {"particle_storage", name_of(r.layout.particles)},
          {"sums", name_of(r.layout.sums)},
          {"numbers", numbers_of(r.layout)},
          {"ns_per_bond_median", r.median()},
          {"ns_per_bond_least", r.spread().least},
          {"ns_per_bond_most", r.spread().most},
          {"bonds_per_s", r.bonds_per_second()},
          {"time_over_production", r.median() / group.results.front().median()},
          {"limit_ns_per_bond", 1e9 * r.limit.time()},
          {"limited_by", r.limit.memory > r.limit.arithmetic ? "memory" : "arithmetic"},
          {"fraction_of_limit", r.fraction_of_limit()},
          {"difference", r.difference},
          {"colours", r.colours},
          {"passes_per_block", r.passes}};
}

/// Of production in a precision.
Json limits_of(const LayoutsGroup& group, const LayoutResult& r) {
  const ByteCount& bytes = group.bytes.of(r.layout.precision);
  return {{"spheres", group.spheres},
          {"bonds", group.bonds},
          {"threads", group.threads},
          {"precision", name_of(r.layout.precision)},
          {"set_bytes_per_bond", bytes.set},
          {"read_bytes_per_bond", bytes.read},
          {"written_bytes_per_bond", bytes.written},
          {"bandwidth_bytes_per_s", r.peak.bandwidth},
          {"peak_operations_per_s", r.peak.operations},
          {"memory_ns_per_bond", 1e9 * r.limit.memory},
          {"arithmetic_ns_per_bond", 1e9 * r.limit.arithmetic}};
}

Json of(const OperationCount& n) {
  return {{"total", n.total()},       {"additions", n.additions}, {"multiplications", n.multiplications},
          {"divisions", n.divisions}, {"roots", n.roots},         {"comparisons", n.comparisons}};
}

}  // namespace

void write_layouts_csv(const std::filesystem::path& file, const LayoutsResults& results) {
  std::vector<Json> rows;
  for (const LayoutsGroup& group : results.groups)
    for (const LayoutResult& r : group.results) rows.push_back(values_of(group, r));
  atomic_write(file, csv_of(rows));
}

void write_layouts_json(const std::filesystem::path& file, const LayoutsResults& results) {
  Json limits = Json::array(), runs = Json::array();
  for (const LayoutsGroup& group : results.groups) {
    for (const Precision precision : {Precision::single, Precision::full})
      limits.push_back(limits_of(group, production(group, precision)));
    for (const LayoutResult& r : group.results)
      runs.emplace_back(values_of(group, r))["block_ns_per_bond"] = r.block_ns;
  }
  const Json all{
      {"study", "layouts"},
      {"version", results.machine.version},
      {"machine", json_of(results.machine)},
      {"test",
       {{"material", results.material}, {"law", "dempack"}, {"block_s", results.timing.block_seconds}}},
      {"operations_per_bond",
       {{"single", of(results.operations.single)}, {"double", of(results.operations.full)}}},
      {"limits", limits},
      {"runs", runs}};
  atomic_write(file, all.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
}

}  // namespace breccia
