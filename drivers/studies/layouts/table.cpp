#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "drivers/studies/layouts/results.hpp"
#include "io/text/text_table.hpp"

namespace breccia {

const LayoutResult& production(const LayoutsGroup& group, Precision precision) {
  return *std::ranges::find(group.results, precision,
                            [](const LayoutResult& r) { return r.layout.precision; });
}

std::string layouts_heading(const LayoutsResults& r) {
  const Machine& m = r.machine;
  std::string text = fmt::format(
      "bond pass of a packed cylinder of {}, law dempack; medians of {} blocks of {:g} s\n"
      "{}, {} of {} cores, {}, {}; load average {:.2f}",
      r.material, r.timing.repeat, r.timing.block_seconds, m.cpu, m.cores, m.cores_online, m.instruction_set,
      m.compiler, m.load_average);
  for (const Precision precision : {Precision::single, Precision::full}) {
    const OperationCount& n = r.operations.of(precision);
    text += fmt::format(
        "\n{}: {} operations per bond: {} additions, {} multiplications, {} divisions, {} roots; and {} "
        "comparisons",
        name_of(precision), n.total(), n.additions, n.multiplications, n.divisions, n.roots, n.comparisons);
  }
  return text;
}

std::string format_layouts_group(const LayoutsGroup& group, const Both<OperationCount>& operations) {
  const LayoutResult& first = group.results.front();
  std::string text = fmt::format("\n{} spheres, {} bonds, {} thread{}\n", group.spheres, group.bonds,
                                 group.threads, group.threads > 1 ? "s" : "");
  for (const Precision precision : {Precision::single, Precision::full}) {
    const LayoutResult& r = production(group, precision);
    const double wider = precision == Precision::single ? 2.0 : 1.0;  // a register holds twice as many
    text += fmt::format(
        "  {}: {:.0f} B per bond at {:.1f} GB/s: {:.2f} ns; {} operations at {:.1f} per ns: {:.2f} ns\n",
        name_of(precision), group.bytes.of(precision).moved(), 1e-9 * r.peak.bandwidth, 1e9 * r.limit.memory,
        operations.of(precision).total(), wider * 1e-9 * r.peak.operations, 1e9 * r.limit.arithmetic);
  }
  std::vector<TextColumn> columns;
  const auto add = [&](const char* name, const char* unit,
                       const std::function<std::string(const LayoutResult&)>& cell) {
    TextColumn& column = columns.emplace_back(TextColumn{name, unit, {}});
    for (const LayoutResult& r : group.results) column.cells.push_back(cell(r));
  };
  add("precision", "", [](const auto& r) { return std::string(name_of(r.layout.precision)); });
  add("bonds", "", [](const auto& r) { return std::string(name_of(r.layout.bonds)); });
  add("particles", "", [](const auto& r) { return std::string(name_of(r.layout.particles)); });
  add("sums", "", [](const auto& r) { return std::string(name_of(r.layout.sums)); });
  add("of", "", [](const auto& r) { return std::string(numbers_of(r.layout)); });
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
