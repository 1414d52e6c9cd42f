#include "drivers/studies/scaling/program.hpp"

#include <fmt/format.h>

#include "core/base/hold.hpp"
#include "drivers/programs/command_line.hpp"
#include "drivers/studies/scaling/results.hpp"
#include "drivers/studies/study_options.hpp"
#include "io/files/run_folder.hpp"
#include "io/results/progress.hpp"

namespace breccia {
namespace {

std::string heading(const ScalingOptions& o, const ScalingResults& r) {
  const Machine& m = r.machine;
  std::string text = fmt::format(
      "uniaxial compression of a packed cylinder of {}, {:.0f} x {:.0f} mm, law dempack, affine area "
      "factor\n",
      r.material, 1e3 * scaling_body.diameter, 1e3 * scaling_body.height);
  text += fmt::format("medians of {} blocks of {} steps after {} of warm-up; a row of the curve every {}\n",
                      o.blocks.repeat, o.blocks.steps, o.blocks.warm_up, ScalingBlocks::steps_per_row);
  text += fmt::format("{}, {} of {} cores, {}, {}; load average {:.2f}", m.cpu, m.cores, m.cores_online,
                      m.instruction_set, m.compiler, m.load_average);
  if (o.threads.back() > m.cores)
    text += fmt::format("\nwarning: {} threads share {} cores", o.threads.back(), m.cores);
  return text;
}

void run_study(const ScalingOptions& options) {
  const Ranks ranks = ranks_of_launcher();
  const std::vector<ScalingPoint> points = scaling_points(options, ranks.count);
  ScalingResults results{describe_machine(), options.blocks, "concrete", {}};
  const Material material = shipped_material(results.material, "breccia-scaling");
  FolderLock lock;
  if (ranks.is_root())
    lock = claim_run_folder(options.out, options.force ? Old::replace : Old::refuse,
                            {{"scaling.csv", "scaling.json"}, {}});
  Progress progress = make_progress(options.quiet || !ranks.is_root());
  say(progress, heading(options, results));
  // a signal ends the program at once: the files hold what has been measured
  ScalingSpecimen specimen;
  std::size_t spheres = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const ScalingPoint& point = points[k];
    if (point.spheres != spheres) {
      say(progress, fmt::format("packing {} spheres", point.spheres));
      specimen = {};  // never two at a time
      specimen = make_scaling_specimen(point.spheres, material, options.threads.back());
      spheres = point.spheres;
    }
    begin(progress, fmt::format("{} of {}, {}", k + 1, points.size(), describe(point)));
    const ScalingProgress shown = [&](const World& w, double fraction, const CurveRow& row) {
      tell(progress, w, 2, fraction, row);
    };
    results.runs.push_back(measure_scaling(specimen, material, point, options.blocks, shown, ranks));
    if (!ranks.is_root()) continue;
    write_scaling_csv(options.out / "scaling.csv", results);
    write_scaling_json(options.out / "scaling.json", results);
    hold_at(HoldPoint::measurement);
    say(progress, describe(results.runs.back(), results.runs));
  }
  if (!ranks.is_root()) return;
  say(progress, format_scaling_tables(results) + format_comparison(results));
  say(progress, fmt::format("written: {}, {}", (options.out / "scaling.csv").string(),
                            (options.out / "scaling.json").string()));
}

}  // namespace

int run_scaling_program(int argc, char** argv) {
  ScalingOptions options;
  if (const auto code = read_scaling_options(argc, argv, options)) return *code;
  return run_body(
      "breccia-scaling", options.threads.back(), [&] { run_study(options); }, true);
}

}  // namespace breccia
