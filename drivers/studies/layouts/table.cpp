#include <fmt/format.h>

#include <functional>

#include "drivers/studies/layouts/results.hpp"
#include "io/text/text_table.hpp"

namespace breccia {

std::string layouts_heading(const LayoutsResults& r) {
  const Machine& m = r.machine;
  const OperationCount& n = r.operations;
  return fmt::format(
      "bond pass of a packed cylinder of {}, law dempack; medians of {} blocks of {:g} s\n"
      "{}, {} of {} cores, {}, {}; load average {:.2f}\n"
      "{} operations per bond: {} additions, {} multiplications, {} divisions, {} roots; and {} comparisons",
      r.material, r.timing.repeat, r.timing.block_seconds, m.cpu, m.cores, m.cores_online, m.instruction_set,
      m.compiler, m.load_average, n.total(), n.additions, n.multiplications, n.divisions, n.roots,
      n.comparisons);
}

std::string format_layouts_group(const LayoutsGroup& group, const OperationCount& operations) {
  const LayoutResult& first = group.results.front();
  std::string text = fmt::format(
      "\n{} spheres, {} bonds, {} thread{}\n"
      "  {:.0f} B per bond at {:.1f} GB/s: {:.2f} ns; {} operations at {:.1f} per ns: {:.2f} ns\n",
      group.spheres, group.bonds, group.threads, group.threads > 1 ? "s" : "", group.bytes.moved(),
      1e-9 * first.peak.bandwidth, 1e9 * first.limit.memory, operations.total(), 1e-9 * first.peak.operations,
      1e9 * first.limit.arithmetic);
  std::vector<TextColumn> columns;
  const auto add = [&](const char* name, const char* unit,
                       const std::function<std::string(const LayoutResult&)>& cell) {
    TextColumn& column = columns.emplace_back(TextColumn{name, unit, {}});
    for (const LayoutResult& r : group.results) column.cells.push_back(cell(r));
  };
  add("bonds", "", [](const auto& r) { return std::string(name_of(r.layout.bonds)); });
  add("particles", "", [](const auto& r) { return std::string(name_of(r.layout.particles)); });
  add("sums", "", [](const auto& r) { return std::string(name_of(r.layout.sums)); });
  add("median", "ns/bond", [](const auto& r) { return four_digits(r.median()); });
  add("least", "ns/bond", [](const auto& r) { return four_digits(r.spread().least); });
  add("most", "ns/bond", [](const auto& r) { return four_digits(r.spread().most); });
  add("rate", "Mbond/s", [](const auto& r) { return fmt::format("{:.1f}", 1e-6 * r.bonds_per_second()); });
  add("time", "production",
      [&](const auto& r) { return fmt::format("{:.2f}", r.median() / first.median()); });
  add("limit", "fraction", [](const auto& r) { return fmt::format("{:.2f}", r.fraction_of_limit()); });
  add("difference", "1", [](const auto& r) { return fmt::format("{:.1e}", r.difference); });
  add("colours", "1", [](const auto& r) { return r.colours ? fmt::format("{}", r.colours) : std::string(); });
  return text + format_columns(columns);
}

}  // namespace breccia
