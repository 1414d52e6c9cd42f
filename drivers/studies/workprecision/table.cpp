#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>

#include "drivers/studies/workprecision/results.hpp"
#include "io/text/text_table.hpp"

namespace breccia {
namespace {

double value(const Errors& errors, Measure m) { return errors[static_cast<std::size_t>(m)]; }

constexpr std::array<std::string_view, all_measures.size()> headings{"peak", "E", "strain", "curve"};
std::string_view heading_of(Measure m) { return headings[static_cast<std::size_t>(m)]; }

/// In per cent, with its sign; empty for NaN.
std::string signed_percent(double fraction) {
  return std::isnan(fraction) ? "" : fmt::format("{:+.2f}", 100.0 * fraction);
}
std::string percent(double fraction) {
  return std::isnan(fraction) ? "" : fmt::format("{:.2f}", 100.0 * fraction);
}
/// Of an error: that of a curve has no sign.
std::string error_of(const Errors& errors, Measure m) {
  return m == Measure::curve ? percent(value(errors, m)) : signed_percent(value(errors, m));
}

std::string words(const WorkPrecisionResults& r) {
  return r.confinement > 0 ? fmt::format("{} at {:.4g} MPa", r.test, r.confinement * 1e-6) : r.test;
}

/// A letter for each front that the run lies on.
std::string fronts_with(const Analysis& a, std::size_t run) {
  std::string letters;
  for (const Front& front : a.fronts)
    if (std::find(front.runs.begin(), front.runs.end(), run) != front.runs.end())
      letters += heading_of(front.measure).front();
  return letters;
}

}  // namespace

std::string describe(const Finished& run, const std::optional<Analysis>& analysis) {
  const auto& [trial, o] = run;
  std::string text = fmt::format("{}: {}", name_of(trial.purpose), describe(trial.recipe));
  if (trial.spheres) text += fmt::format(", {} spheres, seed {}", trial.spheres, trial.seed);
  if (trial.shake) text += fmt::format(", perturbation {}", trial.shake);
  if (!o.failure.empty()) return text + ": broke, " + o.failure;
  text += fmt::format(": peak {:.4g} MPa", o.readings.peak * 1e-6);
  if (analysis)
    text += fmt::format(" ({} %)", signed_percent(o.readings.peak / analysis->reference.mean.peak - 1.0));
  return text + fmt::format(", {} steps in {:.2f} s", o.steps, o.run_time);
}

std::string format_reference(const WorkPrecisionResults& results) {
  if (!results.analysis) return "the reference is not there yet\n";
  const Reference& r = results.analysis->reference;
  std::vector<TextColumn> columns{
      {"", "", {"reference", "half the step", "half the speed", "error bar", "noise floor"}}};
  for (const Measure m : all_measures) {
    const std::string mean = m == Measure::peak             ? fmt::format("{:.4g} MPa", r.mean.peak * 1e-6)
                             : m == Measure::young          ? fmt::format("{:.4g} GPa", r.mean.young * 1e-9)
                             : m == Measure::strain_at_peak ? fmt::format("{:.3e}", r.mean.strain_at_peak)
                                                            : "";
    columns.push_back({std::string(heading_of(m)),
                       "%",
                       {mean, error_of(r.half_step, m), error_of(r.half_speed, m), percent(value(r.bar, m)),
                        percent(value(r.floor, m))}});
  }
  return fmt::format(
      "\n{}, {}: {} runs from perturbed positions; their mean is the reference, the spread of one the noise "
      "floor\n{}",
      words(results), describe(r.recipe), r.runs, format_columns(columns));
}

std::string format_recipes(const WorkPrecisionResults& results) {
  if (!results.analysis) return "";
  const Analysis& a = *results.analysis;
  std::vector<TextColumn> columns;
  const auto add = [&](const std::string& name, const std::string& unit,
                       const std::function<std::string(std::size_t)>& cell) {
    TextColumn& column = columns.emplace_back(TextColumn{name, unit, {}});
    for (std::size_t k = 0; k < results.runs.size(); ++k)
      if (results.runs[k].trial.purpose == Purpose::recipe) column.cells.push_back(cell(k));
  };
  const auto recipe = [&](std::size_t k) -> const Recipe& { return results.runs[k].trial.recipe; };
  add("family", "", [&](std::size_t k) { return std::string(name_of(results.runs[k].trial.family)); });
  add("step", "limit", [&](std::size_t k) { return fmt::format("{}", recipe(k).safety); });
  add("speed", "m/s", [&](std::size_t k) { return fmt::format("{}", recipe(k).platen_speed); });
  add("scheme", "", [&](std::size_t k) { return std::string(name_of(recipe(k).scheme)); });
  add("mass", "1", [&](std::size_t k) { return fmt::format("{}", recipe(k).mass_factor); });
  add("damping", "1", [&](std::size_t k) { return fmt::format("{}", recipe(k).damping.translation); });
  add("precision", "", [&](std::size_t k) { return std::string(name_of(recipe(k).precision)); });
  add("scatter", "", [&](std::size_t k) { return std::string(name_of(recipe(k).scatter)); });
  add("steps", "1", [&](std::size_t k) { return fmt::format("{}", results.runs[k].outcome.steps); });
  add("time", "s", [&](std::size_t k) { return four_digits(results.runs[k].outcome.run_time); });
  for (const Measure m : all_measures)
    add(std::string(heading_of(m)), "%", [&, m](std::size_t k) { return error_of(a.errors[k], m); });
  add("front", "",
      [&](std::size_t k) { return results.runs[k].outcome.failure.empty() ? fronts_with(a, k) : "broke"; });
  if (columns.front().cells.empty()) return "";
  return "\nrecipes: errors against the reference; front: the measures for which none is cheaper and "
         "better\n" +
         format_columns(columns);
}

std::string format_sizes(const WorkPrecisionResults& results) {
  if (!results.analysis || results.analysis->sizes.empty()) return "";
  const Analysis& a = *results.analysis;
  TextColumn spheres{"spheres", "1", {}}, seeds{"seeds", "1", {}}, time{"time", "s", {}};
  std::vector<TextColumn> columns;
  for (const SizeGroup& g : a.sizes) {
    spheres.cells.push_back(fmt::format("{}", g.spheres));
    seeds.cells.push_back(fmt::format("{}", g.seeds));
    time.cells.push_back(four_digits(g.run_time));
  }
  columns = {spheres, seeds, time};
  for (const Measure m : all_measures) {
    TextColumn mean{std::string(heading_of(m)), "%", {}}, spread{"spread", "%", {}};
    for (const SizeGroup& g : a.sizes) {
      mean.cells.push_back(error_of(g.mean, m));
      spread.cells.push_back(percent(value(g.spread, m)));
    }
    columns.push_back(mean);
    if (m != Measure::curve) columns.push_back(spread);
  }
  std::string text =
      "\nother specimens, one thread each: mean and spread over the seeds, against the reference of the "
      "case's own specimen (sampling error)\n" +
      format_columns(columns);
  if (const auto& fit = a.fits[static_cast<std::size_t>(Measure::peak)])
    text +=
        fmt::format("  spread of the peak: {:.3g} % (n/1000)^{:.2f}; with n^-1/2: {:.3g} % (n/1000)^-0.5\n",
                    100.0 * fit->factor * std::pow(1000.0, fit->exponent), fit->exponent,
                    100.0 * fit->factor_half / std::sqrt(1000.0));
  return text;
}

std::string format_cheapest(const WorkPrecisionResults& results) {
  if (!results.analysis) return "";
  std::string text =
      "\ncheapest recipes whose error, with what the reference leaves open, is within a tolerance; all: "
      "peak, E, "
      "strain at the peak and curve\n";
  std::set<std::size_t> chosen;
  for (const Cheapest& c : results.analysis->cheapest) {
    if (c.measure && *c.measure != Measure::peak) continue;  // the others are in the files
    text += fmt::format("  {:>4} within {:g} %: ", c.measure ? "peak" : "all", 100.0 * c.tolerance);
    if (!c.run) {
      text += "none\n";
      continue;
    }
    const Finished& run = results.runs[*c.run];
    text += fmt::format("{:>8} s  {}\n", four_digits(run.outcome.run_time), describe(run.trial.recipe));
    chosen.insert(*c.run);
  }
  for (const std::size_t k : chosen) {
    const Recipe& r = results.runs[k].trial.recipe;
    text += fmt::format("\n# {}\n{}", describe(r), case_lines(r));
  }
  return text;
}

}  // namespace breccia
