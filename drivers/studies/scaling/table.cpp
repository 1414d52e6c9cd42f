#include <fmt/format.h>

#include <functional>

#include "drivers/studies/scaling/results.hpp"
#include "io/text/text_table.hpp"

namespace breccia {
namespace {

using Cell = std::function<std::string(const ScalingRun&)>;

std::vector<TextColumn> columns_of(const std::vector<const ScalingRun*>& shown,
                                   const std::vector<ScalingRun>& runs) {
  std::vector<TextColumn> columns;
  const auto add = [&](std::string_view name, std::string_view unit, const Cell& cell) {
    TextColumn& column = columns.emplace_back(TextColumn{std::string(name), std::string(unit), {}});
    for (const ScalingRun* run : shown) column.cells.push_back(cell(*run));
  };
  using R = ScalingRun;
  add("precision", "", [](const R& r) { return std::string(name_of(r.point.precision)); });
  add("scatter", "", [](const R& r) { return std::string(name_of(r.point.scatter)); });
  add("spheres", "1", [](const R& r) { return fmt::format("{}", r.point.spheres); });
  add("bonds", "1", [](const R& r) { return fmt::format("{}", r.bonds); });
  add("ranks", "1", [](const R& r) { return fmt::format("{}", r.ranks); });
  add("threads", "1", [](const R& r) { return fmt::format("{}", r.point.threads); });
  add("step", "ms", [](const R& r) { return four_digits(1e3 * step_time(r).median); });
  add("least", "ms", [](const R& r) { return four_digits(1e3 * step_time(r).least); });
  add("most", "ms", [](const R& r) { return four_digits(1e3 * step_time(r).most); });
  add("per bond", "ns", [](const R& r) { return four_digits(1e9 / bond_updates(r)); });
  add("updates", "Mbond/s", [](const R& r) { return four_digits(1e-6 * bond_updates(r)); });
  add("speed-up", "1", [&](const R& r) { return fmt::format("{:.2f}", gain_of(r, runs).speed_up); });
  add("efficiency", "1", [&](const R& r) { return fmt::format("{:.2f}", gain_of(r, runs).efficiency); });
  const auto share = [](double seconds, const R& r) {
    const double percent = 100.0 * seconds / r.all_seconds();
    return percent >= 0.05 ? fmt::format("{:.1f}", percent) : std::string();
  };
  for (std::size_t k = 0; k < phase_names.size(); ++k)
    add(phase_names[k], "%", [&](const R& r) { return share(r.phases.seconds[k], r); });
  add("other", "%", [&](const R& r) { return share(r.all_seconds() - r.phases.total(), r); });
  add("tables", "B/bond", [](const R& r) { return fmt::format("{:.0f}", table_bytes_per_bond(r)); });
  add("memory", "MB", [](const R& r) {
    return r.peak_bytes ? fmt::format("{:.0f}", 1e-6 * static_cast<double>(r.peak_bytes)) : std::string();
  });
  return columns;
}

std::string study_table(const ScalingResults& results, ScalingStudy study, std::string_view title) {
  std::vector<const ScalingRun*> shown;
  for (const ScalingRun& run : results.runs)
    if (run.point.study == study) shown.push_back(&run);
  return shown.empty() ? "" : fmt::format("\n{}\n{}", title, format_columns(columns_of(shown, results.runs)));
}

}  // namespace

std::string format_scaling_tables(const ScalingResults& results) {
  return study_table(results, ScalingStudy::strong, "strong scaling: the same specimen on more threads") +
         study_table(results, ScalingStudy::weak, "weak scaling: as many spheres for each thread");
}

std::string describe(const ScalingPoint& p) {
  return fmt::format("{}, {} precision, {}: {} spheres, {} thread{}", name_of(p.study), name_of(p.precision),
                     name_of(p.scatter), p.spheres, p.threads, p.threads == 1 ? "" : "s");
}

std::string describe(const ScalingRun& run, const std::vector<ScalingRun>& runs) {
  const MedianAndRange t = step_time(run);
  return fmt::format("{}: {} ms per step ({} to {}), {} ns per bond, speed-up {:.2f}", describe(run.point),
                     four_digits(1e3 * t.median), four_digits(1e3 * t.least), four_digits(1e3 * t.most),
                     four_digits(1e9 / bond_updates(run)), gain_of(run, runs).speed_up);
}

}  // namespace breccia
