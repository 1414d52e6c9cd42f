#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
#include <string_view>

#include "io/results/summary_json.hpp"
#include "io/text/text_table.hpp"

namespace breccia {
namespace {

struct Column {
  std::string_view name, unit;
  std::function<std::string(const RunSummary&)> text;  ///< empty where the run has no value
};

bool is_known(const std::optional<double>& value) { return value && std::isfinite(*value); }

/// A quantity in a unit of `scale` SI; decimals as an engineer quotes it.
Column number(std::string_view name, std::string_view unit, double scale, int decimals,
              std::optional<double> RunSummary::*value) {
  return {name, unit, [=](const RunSummary& run) {
            return is_known(run.*value) ? fmt::format("{:.{}f}", *(run.*value) / scale, decimals)
                                        : std::string();
          }};
}

std::vector<Column> columns() {
  using R = RunSummary;
  return {
      {"confinement", "MPa", [](const R& run) { return fmt::format("{:.4g}", run.confinement_Pa / 1e6); }},
      {"peak", "MPa",
       [](const R& run) {
         if (!is_known(run.peak_stress_Pa)) return std::string();
         // the largest stress so far is not a strength
         return fmt::format("{}{:.2f}", run.peak_reached ? "" : "> ", *run.peak_stress_Pa / 1e6);
       }},
      {"held", "MPa",
       [](const R& run) {  // where it is not what was asked for
         if (!is_known(run.confining_stress_at_peak_Pa)) return std::string();
         const double held = *run.confining_stress_at_peak_Pa, asked = run.confinement_Pa;
         return std::abs(held - asked) > 0.005 * asked ? fmt::format("{:.4g}", held / 1e6) : std::string();
       }},
      number("deviator", "MPa", 1e6, 2, &R::peak_deviator_Pa),
      number("tensile", "MPa", 1e6, 3, &R::tensile_strength_Pa),
      number("at strain", "%", 1e-2, 3, &R::strain_at_peak),
      number("E", "GPa", 1e9, 2, &R::young_modulus_Pa),
      number("E50", "GPa", 1e9, 2, &R::young_modulus_50_Pa),
      number("nu", "1", 1, 3, &R::poisson_ratio),
      number("cracks from", "MPa", 1e6, 2, &R::crack_initiation_stress_Pa),
      number("unstable from", "MPa", 1e6, 2, &R::crack_damage_stress_Pa),
      number("cutting force", "N", 1, 1, &R::cutting_force_N),
      number("thrust", "N", 1, 1, &R::thrust_N),
      number("specific energy", "MJ/m^3", 1e6, 3, &R::specific_energy_J_per_m3),
      {"broken", "tens./shear",
       [](const R& run) { return fmt::format("{}/{}", run.broken_tension, run.broken_shear); }},
      {"energy error", "1",
       [](const R& run) {
         return is_known(run.energy_error) ? fmt::format("{:.1e}", *run.energy_error) : std::string();
       }},
      {"run time", "s", [](const R& run) { return fmt::format("{:.1f}", run.run_time_s); }},
      number("bonds", "M/s", 1e6, 1, &R::bond_updates_per_s),
      {"stopped by", "", [](const R& run) { return run.stopped_by; }},
  };
}

std::string results_of(const std::vector<RunSummary>& runs) {
  std::vector<TextColumn> table;
  for (const Column& column : columns()) {
    TextColumn& shown =
        table.emplace_back(TextColumn{std::string(column.name), std::string(column.unit), {}});
    for (const RunSummary& run : runs) shown.cells.push_back(column.text(run));
  }
  return format_columns(table);
}

/// Shares of the phases in the time of all runs, largest first; what no phase claims is "other".
std::string times_of(const std::vector<RunSummary>& runs) {
  std::vector<std::pair<std::string, double>> phases;
  double total = 0;
  for (const RunSummary& run : runs) {
    total += run.run_time_s;
    for (const auto& [name, seconds] : run.phases_s) {
      const auto known =
          std::find_if(phases.begin(), phases.end(), [&](const auto& p) { return p.first == name; });
      if (known == phases.end()) {
        phases.emplace_back(name, seconds);
      } else {
        known->second += seconds;
      }
    }
  }
  double claimed = 0;
  for (const auto& phase : phases) claimed += phase.second;
  if (total <= 0) return "";
  std::stable_sort(phases.begin(), phases.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  if (claimed < total) phases.emplace_back("other", total - claimed);
  std::string text = fmt::format("time {:.1f} s:", total);
  for (const auto& [name, seconds] : phases) {
    if (const double share = 100 * seconds / total; share >= 0.05)
      fmt::format_to(std::back_inserter(text), "  {} {:.1f} %", name, share);
  }
  return text + '\n';
}

/// What the peak of a run may be off by, beside the time that it took.
std::string error_of(const RunSummary& run) {
  if (!is_known(run.rate_error)) return "";
  const auto percent = [](double part) { return fmt::format("{:.2g} %", 100.0 * part); };
  return fmt::format(
      "peak at {:.4g} MPa: error from the rate about {}, from the step {}, over packings {} "
      "(one standard deviation); in {:.1f} s\n",
      run.confinement_Pa / 1e6, percent(*run.rate_error),
      is_known(run.step_error) ? percent(*run.step_error) : "not known without the energy ledger",
      percent(*run.sampling_error), run.run_time_s);
}

/// What a series has really written, of what it may write: first and last where there is one for
/// each run.
std::vector<std::string> files_of(const SeriesSummary& series, const std::filesystem::path& folder) {
  std::vector<std::string> files;
  std::error_code ignored;
  const auto add = [&](const std::string& name) {
    const std::filesystem::path file = folder / name;
    if (std::filesystem::exists(file, ignored)) files.push_back(file.string());
  };
  const auto add_of_runs = [&](std::string_view before, std::string_view after) {
    const auto name = [&](std::size_t run) { return fmt::format("{}{}{}", before, run, after); };
    const std::size_t held = files.size(), last = series.runs.size();
    for (std::size_t run = 0; run < last; ++run) add(name(run));
    if (files.size() - held <= 3) return;
    files[held] += " to " + files.back();
    files.resize(held + 1);
  };
  add("case.toml");
  add("summary.json");
  add_of_runs("curve-", ".csv");
  add_of_runs("cracks-", ".csv");
  add("results.h5");
  add_of_runs("frames/run-", ".pvd");
  return files;
}

}  // namespace

std::string format_summary_table(const SeriesSummary& series, const std::filesystem::path& folder) {
  std::string text = results_of(series.runs);
  const auto out = std::back_inserter(text);
  if (const auto& line = series.mohr_coulomb) {
    fmt::format_to(
        out,
        "Mohr-Coulomb from {} peaks: cohesion {:.2f} MPa, friction angle {:.1f} deg, residual {:.2f} MPa\n",
        line->peaks, line->cohesion_Pa / 1e6, line->friction_angle_deg, line->residual_Pa / 1e6);
  }
  if (!series.no_mohr_coulomb.empty())
    fmt::format_to(out, "Mohr-Coulomb: none: {}\n", series.no_mohr_coulomb);
  for (std::size_t run = 0; run < series.runs.size(); ++run) {
    for (const std::string& warning : series.runs[run].warnings) {
      fmt::format_to(out, "warning, run {}: {}\n", run, warning);
    }
  }
  for (const RunSummary& run : series.runs) text += error_of(run);
  text += times_of(series.runs);
  std::string files;
  for (const std::string& file : files_of(series, folder)) files += (files.empty() ? "" : ", ") + file;
  fmt::format_to(out, "files: {}\n", files);
  return text;
}

}  // namespace breccia
