#include "drivers/studies/layouts/program.hpp"

#include <fmt/format.h>

#include <chrono>

#include "core/base/hold.hpp"
#include "drivers/programs/command_line.hpp"
#include "drivers/studies/layouts/options.hpp"
#include "drivers/studies/layouts/results.hpp"
#include "drivers/studies/study_options.hpp"
#include "io/files/run_folder.hpp"
#include "io/results/progress.hpp"

namespace breccia {
namespace {

LayoutScene packed(std::size_t spheres, const Material& material, int threads, Progress& progress) {
  const std::string title = fmt::format("packing {} spheres", spheres);
  say(progress, title);
  auto said = std::chrono::steady_clock::now();
  return make_layout_scene(spheres, material, threads, [&](double fraction) {
    const auto now = std::chrono::steady_clock::now();
    if (now - said < std::chrono::seconds(5)) return;
    said = now;
    say(progress, fmt::format("{}: {:.0f} %", title, 100.0 * fraction));
  });
}

/// @returns whether every layout computes what production does
bool run_study(const LayoutsOptions& options) {
  LayoutsResults results{describe_machine(),
                         "concrete",
                         options.timing,
                         {single_operations_per_bond(), operations_per_bond()},
                         {}};
  const Material material = shipped_material(results.material, "breccia-layouts");
  const FolderLock lock = claim_run_folder(options.out, options.force ? Old::replace : Old::refuse,
                                           {{"layouts.csv", "layouts.json"}, {}});
  Progress progress = make_progress(options.quiet);
  say(progress, layouts_heading(results));
  if (options.threads.back() > results.machine.cores)
    say(progress,
        fmt::format("warning: {} threads share {} cores", options.threads.back(), results.machine.cores));
  // a signal ends the program at once: the files hold what has been measured
  bool same = true;
  for (const std::size_t spheres : options.spheres) {
    const LayoutScene scene = packed(spheres, material, options.threads.back(), progress);
    for (const int threads : options.threads) {
      const LayoutsGroup& group = results.groups.emplace_back(
          LayoutsGroup{scene.world.particles.size, scene.world.bonds.size, threads, scene.bytes,
                       study_layouts(scene, threads, options.timing)});
      write_layouts_csv(options.out / "layouts.csv", results);
      write_layouts_json(options.out / "layouts.json", results);
      hold_at(HoldPoint::measurement);
      say(progress, format_layouts_group(group, results.operations));
      for (const LayoutResult& r : group.results) {
        if (r.difference <= allowed_difference(r.layout.precision)) continue;
        same = false;
        fmt::print(
            stderr,
            "breccia-layouts: {} precision, bonds {}, particles {}, sums {} of {}: differs by {:.1e}\n",
            name_of(r.layout.precision), name_of(r.layout.bonds), name_of(r.layout.particles),
            name_of(r.layout.sums), numbers_of(r.layout), r.difference);
      }
    }
  }
  say(progress, fmt::format("written: {}, {}", (options.out / "layouts.csv").string(),
                            (options.out / "layouts.json").string()));
  return same;
}

}  // namespace

int run_layouts_program(int argc, char** argv) {
  LayoutsOptions options;
  if (const auto code = read_layouts_options(argc, argv, options)) return *code;
  bool same = true;
  const int code = run_body("breccia-layouts", options.threads.back(), [&] { same = run_study(options); });
  return code == 0 && !same ? 1 : code;
}

}  // namespace breccia
