#include "drivers/studies/stability/options.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>

#include "drivers/programs/command_line.hpp"
#include "drivers/studies/study_options.hpp"
#include "io/text/suggest.hpp"

namespace breccia {
namespace {

const std::string about =
    "Stiff and extreme scenes at fractions of the largest stable step: which stay bounded, which blow up, "
    "which "
    "are refused or stopped, and why.";

const std::string results = R"(
network    the bonds without any loss, shaken once: energy error and drift
damped     the same with contact damping
law        the whole law under the scene's own loading: the peak, and how it changes with the step
limit      of the step, for each network to seven digits; critical_time_step is held against it

DIR/stability.csv   a line for each scene, part and fraction of the limit
DIR/stability.json  the same with every cause, and the machine
`scripts/plot DIR` draws the map.
Exit code 1: a network blew up within its limit, did not beyond it, or did so unnoticed.)";

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const StabilityScene& scene : stability_scenes()) names.emplace_back(scene.name);
  return names;
}

}  // namespace

std::optional<int> read_stability_options(int argc, char** argv, StabilityOptions& o) {
  CLI::App app(about, "breccia-stability");
  o.threads = available_cores();
  const std::vector<std::string> names = scene_names();
  const auto is_scene = [names](const std::string& word) {
    if (std::find(names.begin(), names.end(), word) != names.end()) return std::string();
    return fmt::format("{}: {}", quote(word), suggest(word, names));
  };
  bool quick = false;
  app.set_version_flag("--version", std::string(BRECCIA_VERSION));
  app.add_option("--only", o.only, "these scenes alone")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("SCENE,SCENE...")
      ->check(CLI::Validator(is_scene, "", "scene"));
  app.add_flag("--list", o.list, "name the scenes and do nothing");
  app.add_flag("--long", o.with_long, "with the scene of 1e7 steps");
  app.add_option(
         "--steps", o.length.network_steps,
         fmt::format("of a network at 0.99 of the limit, a fifth at the others [{}]", o.length.network_steps))
      ->type_name("N")
      ->check(CLI::Range(std::uint64_t{100}, std::uint64_t{1'000'000'000}, "100 to 1000000000"));
  app.add_flag("--quick", quick, "a look: 2000 steps of each network, half of each test")
      ->excludes("--steps");
  std::string precision(name_of(o.length.precision));
  app.add_option("--precision", precision, "of the loop over bonds: single, double [single]")
      ->type_name("WORD")
      ->check(CLI::IsMember({"single", "double"}));
  app.add_option("--threads", o.threads, fmt::format("runs at once, one thread each [{} here]", o.threads))
      ->type_name("N")
      ->check(CLI::Range(1, 4096, "1 to 4096"));
  add_results_options(app, o.out, o.force, o.quiet);
  app.footer(results);
  if (const auto code = read_command_line(app, argc, argv)) return code;
  if (quick) o.length = {2000, 0.5, 0.001};
  o.length.precision = precision == "single" ? Precision::single : Precision::full;
  return std::nullopt;
}

std::vector<const StabilityScene*> chosen_scenes(const StabilityOptions& o) {
  std::vector<const StabilityScene*> chosen;
  for (const StabilityScene& scene : stability_scenes()) {
    const bool named = std::find(o.only.begin(), o.only.end(), scene.name) != o.only.end();
    if (named || (o.only.empty() && (!scene.is_long || o.with_long))) chosen.push_back(&scene);
  }
  return chosen;
}

}  // namespace breccia
