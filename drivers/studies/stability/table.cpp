#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <iterator>

#include "drivers/studies/stability/results.hpp"
#include "io/text/text_table.hpp"

namespace breccia {
namespace {

std::string short_number(double value, std::string_view sign = "") {
  if (!std::isfinite(value)) return {};
  return sign == "+" ? fmt::format("{:+.1e}", value) : fmt::format("{:.1e}", value);
}

std::string percent(double fraction) {
  return std::isfinite(fraction) ? fmt::format("{:+.1f}", 100.0 * fraction) : std::string();
}

}  // namespace

std::string describe(const std::vector<StabilityRun>& runs) {
  std::string text = fmt::format("{}, {}:", runs.front().scene, name_of(runs.front().part));
  for (const StabilityRun& r : runs)
    text += r.verdict == Verdict::refused ? fmt::format(" refused")
                                          : fmt::format(" {:g} {};", r.fraction, name_of(r.verdict));
  if (text.back() == ';') text.pop_back();
  return text;
}

std::string format_stability_table(const StabilityResults& results) {
  std::vector<const StabilityRun*> shown;
  for (const auto& runs : results.parts)
    for (const StabilityRun& r : runs) shown.push_back(&r);
  std::vector<TextColumn> columns;
  const auto add = [&](const char* name, const char* unit,
                       const std::function<std::string(const StabilityRun&)>& cell) {
    TextColumn& column = columns.emplace_back(TextColumn{name, unit, {}});
    for (const StabilityRun* r : shown) column.cells.push_back(cell(*r));
  };
  add("scene", "", [](const auto& r) { return std::string(r.scene); });
  add("part", "", [](const auto& r) { return std::string(name_of(r.part)); });
  add("step", "limit", [](const auto& r) { return r.fraction > 0 ? fmt::format("{:g}", r.fraction) : ""; });
  add("verdict", "", [](const auto& r) { return std::string(name_of(r.verdict)); });
  add("steps", "1", [](const auto& r) { return fmt::format("{}", r.steps); });
  add("limit", "s", [](const auto& r) {
    return std::isfinite(r.exact_dt) ? fmt::format("{:.4g}", r.exact_dt) : std::string();
  });
  add("estimate", "limit", [](const auto& r) {
    const double ratio = r.estimate_dt / r.exact_dt;
    return std::isfinite(ratio) ? fmt::format("{:.4f}", ratio) : std::string();
  });
  add("energy error", "1", [](const auto& r) { return short_number(r.energy_error); });
  add("drift", "1", [](const auto& r) { return short_number(r.drift, "+"); });
  add("broken", "1",
      [](const auto& r) { return std::isfinite(r.broken) ? fmt::format("{}", r.broken) : std::string(); });
  add("peak", "MPa", [](const auto& r) {
    return std::isfinite(r.peak) ? fmt::format("{:.4g}", 1e-6 * r.peak) : std::string();
  });
  add("change", "%", [](const auto& r) { return percent(r.peak_change); });
  std::string text = format_columns(columns);
  const auto out = std::back_inserter(text);
  for (const StabilityRun* r : shown)
    if (r->part == StabilityPart::law && !r->cause.empty())
      fmt::format_to(out, "{}, {:g}: {}\n", r->scene, r->fraction, r->cause);
  for (const StabilityRun* r : shown)
    if (is_amiss(*r))
      fmt::format_to(out, "amiss: {}, {}, {:g}: {}{}{}\n", r->scene, name_of(r->part), r->fraction,
                     name_of(r->verdict), r->cause.empty() ? "" : ": ", r->cause);
  return text;
}

std::string format_scenes() {
  std::string text;
  for (const StabilityScene& scene : stability_scenes())
    fmt::format_to(std::back_inserter(text), "{:14} {}{}\n", scene.name, scene.stresses,
                   scene.is_long ? " (--long)" : "");
  return text;
}

}  // namespace breccia
