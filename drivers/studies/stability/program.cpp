#include "drivers/studies/stability/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <mutex>

#include "core/base/hold.hpp"
#include "core/base/threads.hpp"
#include "drivers/programs/command_line.hpp"
#include "drivers/studies/stability/options.hpp"
#include "drivers/studies/stability/results.hpp"
#include "drivers/studies/study_options.hpp"
#include "io/files/run_folder.hpp"
#include "io/files/standard_streams.hpp"
#include "io/results/progress.hpp"

namespace breccia {
namespace {

struct PartOfScene {
  const StabilityScene* scene;
  StabilityPart part;
};

std::vector<PartOfScene> parts_of(const std::vector<const StabilityScene*>& scenes) {
  std::vector<PartOfScene> parts;
  for (const StabilityScene* scene : scenes)
    for (const StabilityPart part : scene->parts) parts.push_back({scene, part});
  return parts;
}

/// @returns whether nothing is amiss
bool run_study(const StabilityOptions& options) {
  const std::vector<PartOfScene> parts = parts_of(chosen_scenes(options));
  StabilityResults results{describe_machine(), "concrete", options.length, {}};
  const Material material = shipped_material(results.material, "breccia-stability");
  const FolderLock folder = claim_run_folder(options.out, options.force ? Old::replace : Old::refuse,
                                             {{"stability.csv", "stability.json"}, {}});
  Progress progress = make_progress(options.quiet);
  say(progress,
      fmt::format("stiff and extreme scenes of {}, law dempack, at fractions of the largest stable "
                  "step; {} steps of a network at 0.99; {} precision",
                  results.material, options.length.network_steps, name_of(options.length.precision)));
  results.parts.resize(parts.size());
  // a signal ends the program at once: the files hold what has been run
  std::mutex one_at_a_time;
  for_tasks(
      parts.size(),
      [&](std::size_t k) {
        std::vector<StabilityRun> runs =
            study_stability(*parts[k].scene, parts[k].part, material, options.length);
        const std::lock_guard lock(one_at_a_time);
        say(progress, describe(runs));
        results.parts[k] = std::move(runs);
        write_stability_csv(options.out / "stability.csv", results);
        write_stability_json(options.out / "stability.json", results);
        hold_at(HoldPoint::measurement);
      },
      tbb::simple_partitioner{});
  say(progress, fmt::format("\n{}", format_stability_table(results)));
  say(progress, fmt::format("written: {}, {}", (options.out / "stability.csv").string(),
                            (options.out / "stability.json").string()));
  return std::none_of(results.parts.begin(), results.parts.end(),
                      [](const auto& runs) { return std::any_of(runs.begin(), runs.end(), is_amiss); });
}

}  // namespace

int run_stability_program(int argc, char** argv) {
  StabilityOptions options;
  if (const auto code = read_stability_options(argc, argv, options)) return *code;
  if (options.list) {
    return run_body("breccia-stability", 1, [] { print_out(format_scenes()); });
  }
  bool fine = true;
  const int code = run_body("breccia-stability", options.threads, [&] { fine = run_study(options); });
  return code == 0 && !fine ? 1 : code;
}

}  // namespace breccia
