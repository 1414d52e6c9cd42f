#include "io/pack_program.hpp"

#include <fmt/format.h>

#include <chrono>

#include "core/error.hpp"
#include "io/case.hpp"
#include "io/read_specimen.hpp"
#include "io/ready_specimen.hpp"
#include "io/run_folder.hpp"
#include "io/write_aside.hpp"

namespace breccia {

void run_pack_program(const CommandLine& line) {
  const Case c = load_case(line.case_file, line.sets, line.program);
  Progress progress = make_progress(line.quiet);
  const auto start = std::chrono::steady_clock::now();
  const Specimen specimen = make_specimen(c, progress);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const Assembly a = assemble(specimen, c.specimen.body, {}, Features{}, line.threads);
  say(progress,
      fmt::format("{} spheres in {:.1f} s, mean radius {:.4g} mm, porosity {:.4f}, {:.2f} neighbours within "
                  "1.1 radii",
                  a.particles.size, seconds, a.mean_radius * 1e3, c.specimen.pack->porosity, a.coordination));
  if (line.dry_run || line.explain) return;
  claim_run_folder(line.out, line.force);
  write_aside(line.out / "case.toml", c.resolved);
  write_specimen_csv(line.out / "specimen.csv", specimen);
  say(progress, fmt::format("written: {}", (line.out / "specimen.csv").string()));
}

}  // namespace breccia
