#include "drivers/programs/impact_program.hpp"
#include "drivers/programs/signals.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "core/base/error.hpp"
#include "io/files/atomic_write.hpp"
#include "io/files/digest.hpp"
#include "io/files/run_folder.hpp"
#include "io/impact_cases/impact_case.hpp"
#include "io/results/impact_results.hpp"
#include "io/results/progress.hpp"
#include "io/results/vtp.hpp"

namespace breccia {
namespace {

std::string explain(const ImpactScene& s) {
  const bool hertz = s.law == ContactLaw::hertz_mindlin;
  return fmt::format(
      "law: {}\nused: spin, friction, damping from restitution{}{}\nleft out: bonds, global damping, "
      "checkpoints\n"
      "loops of a step: search if due, pairs, walls, integrate; one thread but for the search\n",
      hertz ? (s.form == HertzForm::classic ? "hertz-mindlin, classic" : "hertz-mindlin, dissipative")
            : "linear",
      norm(s.gravity) > 0.0 ? ", gravity" : "", s.walls.empty() ? "" : ", walls");
}

/// Says every ten seconds how far a run is, and makes its pictures.
ImpactWatch watch_of(const ImpactScene& scene, const CommandLine& line, Progress& progress) {
  using Clock = std::chrono::steady_clock;
  ImpactWatch watch;
  watch.interrupted = [&, last = Clock::now()](double time) mutable {
    if (Clock::now() - last > std::chrono::seconds(10)) {
      last = Clock::now();
      say(progress, fmt::format("{:.4g} s of {:.4g} s", time, scene.duration));
    }
    return interrupted();
  };
  watch.frame = [&](const ParticleTable& particles, int number, double time) {
    write_frame_vtp(line.out / "frames", 0, number, time, particles, {});
  };
  return watch;
}

}  // namespace

void run_impact_program(const CommandLine& line) {
  if (line.resume) fail<BadInput>("--resume: this program makes no checkpoints; run it anew, with --force");
  ImpactCase c = load_impact_case(line.case_file, line.sets);
  c.scene.threads = line.threads;
  Progress progress = make_progress(line.quiet);
  const double critical = critical_impact_step(c.scene);
  say(progress,
      fmt::format("{} particles, {} walls; step {:.4g} s, {:.3g} of the critical {:.4g} s; {:.0f} steps",
                  c.scene.particles.size(), c.scene.walls.size(), c.scene.safety * critical, c.scene.safety,
                  critical, std::ceil(c.scene.duration / (c.scene.safety * critical))));
  if (line.explain) say(progress, explain(c.scene));
  if (line.explain || line.dry_run) return;

  begin_results();
  const bool same = is_resolved_already(line.out, line.case_file, c.resolved);
  FolderUse use{{"curve-0.csv", "spheres.csv", "summary.json"}, {line.case_file}};
  if (!c.scene.walls.empty()) use.writes.emplace_back("walls-0.csv");
  if (c.scene.frames > 0)
    for (const char* name : {"frames/run-0.pvd", "frames/run-0/particles-*.vtp", "frames/run-0/bonds-*.vtp"})
      use.writes.emplace_back(name);
  if (!c.spheres_file.empty()) use.reads.emplace_back(c.spheres_file);
  if (!same) use.writes.emplace_back("case.toml");
  std::vector<std::pair<std::string, std::string>> inputs;
  for (const std::filesystem::path& file : use.reads) inputs.emplace_back(file.string(), sha256_of(file));
  const FolderLock lock = claim_run_folder(line.out, line.force ? Old::replace : Old::refuse, use);
  if (!same) atomic_write(line.out / "case.toml", c.resolved);
  ImpactResult result;
  const auto write_curves = [&] {
    write_impact_curve(line.out / "curve-0.csv", result.rows);
    if (!c.scene.walls.empty()) write_wall_rows(line.out / "walls-0.csv", c.scene, result);
  };
  try {
    run_impact(c.scene, result, watch_of(c.scene, line, progress));
  } catch (const SimulationBroke&) {
    write_curves();
    throw;
  }
  write_curves();
  write_final_spheres(line.out / "spheres.csv", c.scene, result);
  write_impact_summary(line.out / "summary.json", c.scene, result, inputs);
  say(progress, fmt::format("{} steps in {:.2f} s; kinetic energy {:.6g} J before, {:.6g} J after\n",
                            result.steps, result.run_time, result.kinetic_before, result.kinetic_after));
  say(progress, format_impact_table(c.scene, result));
  std::string files;
  for (const std::string& name : use.writes)
    if (name.find('*') == std::string::npos)
      files += fmt::format("{}{}", files.empty() ? "" : ", ", (line.out / name).string());
  say(progress, fmt::format("files: {}", files));
}

}  // namespace breccia
