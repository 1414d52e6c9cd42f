#include "drivers/studies/workprecision/options.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <string>

#include "drivers/programs/command_line.hpp"
#include "drivers/studies/study_options.hpp"
#include "io/text/suggest.hpp"

namespace breccia {
namespace {

const std::string about =
    "Error against run time: the test of CASE.toml (breccia-ucs, or breccia-triaxial where it has a "
    "confinement; its\nfirst run) by many recipes, each held against a reference that takes small steps and "
    "slow platens.";

const std::string results = R"(
reference  explicit dashpots, true masses, full precision, the case's damping; several runs that differ by 1e-12
           of the positions: their mean is the reference, their spread the noise floor; half the step and half
           the speed tell how well the reference is known
recipes    the case as it is, one thing changed at a time, and combinations; each alone on all threads
sizes      specimens of other numbers of spheres, packed in the case's body: what the packing does to a result
families   step, speed, mass, scheme, damping, precision, scatter, combinations, sizes

Reference, noise floor and sizes run as many at a time as there are threads, recipes one at a time.

DIR/workprecision.csv   a line for each run: recipe, steps, run time, readings, errors against the reference
DIR/workprecision.json  the same, the reference with its error bar, the noise floor, the Pareto fronts, the
                        cheapest recipes as lines of a case, the machine
DIR/runs.jsonl          each run as it ended, with its curve: what --resume reads
`scripts/plot DIR` draws them.)";

/// Lets names of families through, and names the one meant for any other.
std::string check_family(const std::string& word) {
  std::vector<std::string> valid;
  for (const Family family : all_families())
    if (family != Family::base) valid.emplace_back(name_of(family));
  if (std::find(valid.begin(), valid.end(), word) != valid.end()) return "";
  return fmt::format("{}: {}", quote(word), suggest(word, valid));
}

std::string check_grid(const std::string& word) {
  if (word == "small" || word == "full") return "";
  return fmt::format("{}: {}", quote(word), suggest(word, {"small", "full"}));
}

/// CLI::Range writes small numbers as 0.000000.
CLI::Validator between(double low, double high) {
  return CLI::Validator(
      [low, high](const std::string& text) {
        double value = 0;
        if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high) return std::string();
        return fmt::format("{} is not a number from {:g} to {:g}", quote(text), low, high);
      },
      "");
}

}  // namespace

std::optional<int> read_workprecision_options(int argc, char** argv, WorkPrecisionOptions& o) {
  CLI::App app(about, "breccia-workprecision");
  o.threads = available_cores();
  std::string grid = "full";
  std::vector<std::string> only;
  std::vector<std::size_t> spheres;
  std::optional<int> seeds, floor;
  std::optional<double> step, speed, perturbation;
  // lists are one word with commas, so that what follows is not taken for their next value
  const auto list = [&](const std::string& name, auto& values, const std::string& meaning) {
    return app.add_option(name, values, meaning)->delimiter(',')->allow_extra_args(false);
  };
  app.set_version_flag("--version", std::string(BRECCIA_VERSION));
  app.add_option("CASE.toml", o.case_file, "the case to run")->required();
  app.add_option("--set", o.sets, "table.key=value, instead of the case's")->allow_extra_args(false);
  app.add_option("--grid", grid, "small: minutes with 1,000 spheres; full: hours with 13,000 [full]")
      ->type_name("WORD")
      ->check(check_grid);
  list("--only", only, "families to run, beside reference and base [all]")
      ->type_name("WORD,WORD...")
      ->check(check_family);
  list("--spheres", spheres, "of the specimens of other sizes [the grid's]")
      ->type_name("N,N...")
      ->check(CLI::Range(std::size_t{50}, std::size_t{100'000'000}, "50 to 100000000"));
  app.add_option("--seeds", seeds, "packings of each of them [the grid's: 3, 5]")
      ->type_name("N")
      ->check(CLI::Range(1, 1000, "1 to 1000"));
  app.add_option("--floor", floor, "runs of the reference [the grid's: 3, 5]")
      ->type_name("N")
      ->check(CLI::Range(2, 1000, "2 to 1000"));
  app.add_option("--perturbation", perturbation, "of their positions, relative [1e-12]")
      ->type_name("X")
      ->check(between(1e-15, 1e-3));
  app.add_option("--reference-step", step, "over the critical step [the grid's: 0.4, 0.2]")
      ->type_name("X")
      ->check(between(0.01, 0.95));
  app.add_option("--reference-speed", speed, "of each platen, m/s [the grid's: 0.05, 0.02]")
      ->type_name("V")
      ->check(between(1e-6, 10.0));
  app.add_option("--threads", o.threads,
                 fmt::format("of a timed run, and runs at a time [{} here]", o.threads))
      ->check(CLI::Range(1, 4096, "1 to 4096"));
  app.add_flag("--dry-run", o.dry_run,
               "say which runs there are and how long they take beside one of the case; write nothing");
  auto* force = app.add_flag("--force", o.force, "replace results that are there");
  app.add_flag("--resume", o.resume, "go on with a study that was interrupted, or add to one")
      ->excludes(force);
  app.add_option("--out", o.out, "folder for the results [out/CASE-workprecision]")->type_name("DIR");
  app.add_flag("--quiet", o.quiet, "errors only");
  app.footer(results);
  if (const auto code = read_command_line(app, argc, argv)) return code;

  o.grid = grid_of(grid == "small" ? GridSize::small : GridSize::full);
  if (!spheres.empty()) {
    sort_unique(spheres);
    o.grid.spheres = spheres;
    o.grid.large = 0;
  }
  if (seeds) o.grid.seeds = *seeds;
  if (floor) o.grid.shakes = *floor;
  if (perturbation) o.grid.shake_size = *perturbation;
  if (step) o.grid.reference_safety = *step;
  if (speed) o.grid.reference_speed = *speed;
  for (const Family family : all_families())
    if (only.empty() || std::find(only.begin(), only.end(), name_of(family)) != only.end())
      o.families.push_back(family);
  if (o.out.empty()) o.out = std::filesystem::path("out") / (o.case_file.stem().string() + "-workprecision");
  return std::nullopt;
}

}  // namespace breccia
