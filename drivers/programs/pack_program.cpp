#include "drivers/programs/pack_program.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>

#include "core/base/error.hpp"
#include "core/geometry/cell_list.hpp"
#include "core/packing/genesis.hpp"
#include "drivers/programs/prepare_specimen.hpp"
#include "io/cases/case.hpp"
#include "io/files/atomic_write.hpp"
#include "io/files/run_folder.hpp"
#include "io/specimens/read_specimen.hpp"

namespace breccia {
namespace {

std::string report(const Specimen& specimen, const SpecimenCase& s, double seconds, int threads) {
  const double n = static_cast<double>(specimen.spheres.size());
  std::vector<Vec3> centres;
  std::vector<double> radii;
  double mean_radius = 0;
  for (const SpecimenSphere& each : specimen.spheres) {
    centres.push_back(each.centre), radii.push_back(each.radius);
    mean_radius += each.radius / n;
  }
  const auto coordination = [&](double range) {
    return 2.0 * static_cast<double>(near_pairs(centres, radii, range, 0.0, threads).size()) / n;
  };
  const packing::Region region(s.body, s.space);
  std::string text = fmt::format(
      "{} {} in {:.1f} s, mean radius {:.4g} mm, porosity {:.4f}, {:.2f} neighbours within 1.1 radii",
      specimen.spheres.size(), region.plane() ? "discs" : "spheres", seconds, mean_radius * 1e3,
      packing::porosity(region, specimen), coordination(0.1));
  if (s.pack->genesis_pressure > 0)
    text += fmt::format(", {:.2f} in contact, genesis pressure {:.4g} k_n", coordination(0.0),
                        packing::wall_pressure(region, radii, centres));
  return text;
}

}  // namespace

void run_pack_program(const CommandLine& line) {
  if (line.resume) fail<BadInput>("--resume: this program makes no checkpoints; run it anew, with --force");
  const Case c = load_case(line.case_file, line.sets, line.program);
  Progress progress = make_progress(line.quiet);
  const auto start = std::chrono::steady_clock::now();
  const Specimen specimen = make_specimen(c, progress);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  say(progress, report(specimen, c.specimen, seconds, line.threads));
  if (line.explain && !c.unusual.empty())
    say(progress, fmt::format("defaults of this case\n  {}", fmt::join(c.unusual, "\n  ")));
  if (line.dry_run || line.explain) return;
  const bool same = is_resolved_already(line.out, c.source, c.resolved);
  FolderUse use{{"specimen.csv"}, c.inputs};
  if (!same) use.writes.emplace_back("case.toml");
  const FolderLock lock = claim_run_folder(line.out, line.force ? Old::replace : Old::refuse, use);
  if (!same) atomic_write(line.out / "case.toml", c.resolved);
  write_specimen_csv(line.out / "specimen.csv", specimen);
  say(progress, fmt::format("files: {}, {}", (line.out / "case.toml").string(),
                            (line.out / "specimen.csv").string()));
}

}  // namespace breccia
