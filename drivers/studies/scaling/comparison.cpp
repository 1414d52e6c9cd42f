#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <optional>
#include <set>

#include "drivers/studies/published_times.hpp"
#include "drivers/studies/scaling/results.hpp"
#include "io/text/text_table.hpp"

namespace breccia {
namespace {

/// Published tests of the same specimen and steps.
using Tests = std::vector<const PublishedTimes*>;

std::vector<Tests> tests_by_source() {
  std::vector<Tests> groups;
  for (const PublishedTimes& p : published_times()) {
    const auto at = std::find_if(groups.begin(), groups.end(),
                                 [&](const Tests& tests) { return tests.front()->source == p.source; });
    (at == groups.end() ? groups.emplace_back() : *at).push_back(&p);
  }
  return groups;
}

/// s, of the whole test.
std::optional<double> published_on(const PublishedTimes& p, int cores) {
  const auto at = std::find(p.cores.begin(), p.cores.end(), cores);
  if (at == p.cores.end()) return std::nullopt;
  return p.seconds[static_cast<std::size_t>(at - p.cores.begin())];
}

using Way = std::pair<Precision, ScatterKind>;

/// Strong scaling of as many spheres as the published test had.
std::vector<const ScalingRun*> runs_like(const PublishedTimes& p, const ScalingResults& results) {
  std::vector<const ScalingRun*> found;
  for (const ScalingRun& run : results.runs)
    if (run.point.study == ScalingStudy::strong && run.point.spheres == p.spheres) found.push_back(&run);
  return found;
}

/// s, for as many steps as the published test had.
std::optional<double> measured_on(const PublishedTimes& p, const std::vector<const ScalingRun*>& runs,
                                  const Way& way, int threads) {
  for (const ScalingRun* run : runs)
    if (run->point.way() == way && run->point.threads == threads)
      return static_cast<double>(p.steps) * step_time(*run).median;
  return std::nullopt;
}

/// A row for each number of cores that somebody has used; a column for each code, and each one's
/// ratio to breccia.
std::string table_of(const Tests& tests, const std::vector<const ScalingRun*>& runs) {
  const PublishedTimes& first = *tests.front();
  std::set<int> cores(first.cores.begin(), first.cores.end());
  std::set<Way> ways;
  for (const ScalingRun* run : runs) cores.insert(run->point.threads), ways.insert(run->point.way());
  std::vector<TextColumn> columns;
  const auto add = [&](const std::string& name, std::string_view unit,
                       const std::function<std::string(int)>& cell) {
    TextColumn& column = columns.emplace_back(TextColumn{name, std::string(unit), {}});
    for (const int n : cores) column.cells.push_back(cell(n));
  };
  add("cores", "1", [](int n) { return fmt::format("{}", n); });
  for (const PublishedTimes* p : tests)
    add(fmt::format("{} {}", p->code, p->parallel), "s", [p](int n) {
      const auto seconds = published_on(*p, n);
      return seconds ? fmt::format("{:.2f}", *seconds) : std::string();
    });
  for (const Way& way : ways) {
    const std::string name = fmt::format("{} {}", name_of(way.first), name_of(way.second));
    add("breccia " + name, "s", [&](int n) {
      const auto seconds = measured_on(first, runs, way, n);
      return seconds ? four_digits(*seconds) : std::string();
    });
    for (const PublishedTimes* p : tests)
      add(fmt::format("{}/{}", p->parallel, name), "1", [&, p](int n) {
        const auto theirs = published_on(*p, n), ours = measured_on(*p, runs, way, n);
        return theirs && ours ? fmt::format("{:.1f}", *theirs / *ours) : std::string();
      });
  }
  return format_columns(columns);
}

}  // namespace

std::string format_comparison(const ScalingResults& results) {
  std::string text;
  const auto out = std::back_inserter(text);
  for (const Tests& tests : tests_by_source()) {
    const PublishedTimes& first = *tests.front();
    const std::vector<const ScalingRun*> runs = runs_like(first, results);
    if (runs.empty()) {
      fmt::format_to(out, "\nnot compared with {}: no strong scaling of {} spheres\n", first.code,
                     first.spheres);
      continue;
    }
    fmt::format_to(
        out,
        "\nbeside {}, another machine: {} spheres, {} steps; breccia's median time of a step times "
        "{}\n{}  {}; {}\n",
        first.code, first.spheres, first.steps, first.steps, table_of(tests, runs), first.source,
        first.machine);
    for (const PublishedTimes* p : tests)
      if (!p->note.empty()) fmt::format_to(out, "  {}: {}\n", p->parallel, p->note);
  }
  return text;
}

}  // namespace breccia
