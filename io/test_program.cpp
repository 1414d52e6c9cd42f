#include "io/test_program.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/stress.hpp"
#include "io/crack_file.hpp"
#include "io/curve.hpp"
#include "io/explain.hpp"
#include "io/ready_specimen.hpp"
#include "io/results_h5.hpp"
#include "io/run_folder.hpp"
#include "io/run_summary.hpp"
#include "io/summary.hpp"
#include "io/vtp.hpp"
#include "io/write_aside.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

Loading loading_of(const std::string& test) {
  if (test == "tension") return Loading::tension;
  if (test == "shear") return Loading::shear;
  if (test == "hydrostatic") return Loading::hydrostatic;
  return Loading::compression;
}

}  // namespace

LoadTest load_test(const Case& c, const std::string& test, std::size_t run) {
  LoadTest load;
  load.loading = loading_of(test);
  load.confinement = c.test.confinement[run];
  load.platen_speed = c.test.platen_speed;
  load.stop_strain = c.test.stop_strain;
  load.stop_after_peak = c.test.stop_after_peak;
  load.frames = c.frames;
  load.unload_at = c.test.unload_at;
  load.unload_to = c.test.unload_to;
  return load;
}

WorldOptions world_options(const Case& c, const std::string& test, const Features& asked, int threads) {
  WorldOptions o;
  o.features = asked;
  o.new_contacts = c.features.new_contacts;
  o.rough_platens = test == "shear" || c.test.rough_platens;
  o.rigid_skin = test == "usc";
  o.skin_weights = c.test.skin_weights;
  o.cracks = c.cracks;
  o.contact_damping = c.damping.contact;
  o.paper_form = c.damping.paper_form;
  o.damping_scheme = c.damping.scheme;
  o.global_damping = {c.damping.translation, c.damping.rotation};
  o.safety = c.safety;
  if (c.mass_scaling) o.mass_factor = c.mass_factor;
  o.scatter = c.scatter;
  o.precision = c.precision;
  o.ledger = c.features.energy_ledger;
  o.threads = threads;
  return o;
}

namespace {

/// Energy per area that the bonds need to part, mean over the bonds; the law's delta fixes it (MODEL section
/// 3).
template <class Law>
std::string fracture_energies(const World& w, const Law& law) {
  double normal = 0, shear = 0, area = 0;
  for (std::size_t k = 0; k < w.bonds.size; ++k) {
    const BondConstants<double> bond = constants_of_bond(w.bonds, k);
    const auto limits = limits_of(law, bond);
    const double length = strain_length(law.young, bond);
    normal +=
        0.5 * limits.tension * limits.tension / bond.stiffness * (1.0 + delta_normal(law.failure, length));
    if (law.shear_ratio > 0)
      shear += 0.5 * limits.cohesion * limits.cohesion / (law.shear_ratio * bond.stiffness) *
               (1.0 + delta_shear(law.failure, length));
    area += bond.strength_area;
  }
  return fmt::format("fracture energies of the bonds, mean: G_I {:.3g}, G_II {:.3g} J/m^2", normal / area,
                     shear / area);
}

std::string scaled_masses(const World& w) {
  if (w.mass_scaling.scaled == 0) return {};
  return fmt::format("; {} spheres made heavier, {:.3f} of the true mass", w.mass_scaling.scaled,
                     w.mass_scaling.factor);
}

std::string step_line(const World& w, double safety) {
  return fmt::format("step {:.4g} s, {:.3g} of the critical {:.4g} s{}{}; {}", w.dt, safety, w.critical_dt,
                     w.options.damping_scheme == DampingScheme::explicit_
                         ? ""
                         : fmt::format(", {} dashpots", name_of(w.options.damping_scheme)),
                     scaled_masses(w),
                     w.options.features.breakage
                         ? std::visit([&](const auto& law) { return fracture_energies(w, law); }, w.law)
                         : "unbreakable bonds");
}

std::string title_of(const Case& c, std::size_t k) {
  const std::size_t runs = c.test.confinement.size();
  const std::string pressure = fmt::format("{:.4g} MPa", c.test.confinement[k] * 1e-6);
  return runs == 1 ? pressure : fmt::format("run {} of {}, {}", k + 1, runs, pressure);
}

/// One run; its files are written even when it breaks off.
RunSummary run_one(const Case& c, const std::string& test, std::size_t k, World& w, const Assembly& a,
                   const fs::path& folder, Progress& progress) {
  const LoadTest load = load_test(c, test, k);
  const int run = static_cast<int>(k);
  begin(progress, title_of(c, k));
  const std::pair<std::string, double> attributes[] = {
      {"confinement_Pa", load.confinement}, {"alpha", w.alpha}, {"time_step_s", w.dt}};
  if (c.frames > 0) begin_run(folder / "results.h5", run, attributes, w.particles, w.bonds);
  std::optional<CrackFile> crack_file;
  if (w.cracks.enabled) crack_file.emplace(folder / fmt::format("cracks-{}.csv", k));

  LoadHooks hooks;
  hooks.interrupted = interrupted;
  hooks.progress = [&](int stage, double fraction, const CurveRow& row) {
    tell(progress, w, stage, fraction, row);
  };
  int frame = 0;
  hooks.frame = [&](World& world, const CurveRow& row) {
    if (c.stress) fill_stress_columns(world);
    append_frame(folder / "results.h5", run, frame, {world.time, world.step, row.axial_strain},
                 world.particles, world.bonds);
    write_frame_vtp(folder / "frames", run, frame, world.time, world.particles, world.bonds);
    ++frame;
  };
  if (crack_file)
    hooks.cracks = [&](std::span<const Crack> cracks, const CurveRow& row) {
      crack_file->add(cracks, row.axial_strain);
    };
  LoadResult result;
  const fs::path curve = folder / fmt::format("curve-{}.csv", k);
  try {
    run_load_test(w, a, load, hooks, result);
  } catch (...) {
    try {
      write_curve(curve, result.record.rows);
    } catch (const FileTrouble&) {  // the first trouble is the one to report
    }
    throw;
  }
  write_curve(curve, result.record.rows);
  return summarise(test, w, a, load, result);
}

std::string result_line(const Case& c, std::size_t k, const std::string& test, const RunSummary& run) {
  const std::string what =
      test == "hydrostatic"
          ? fmt::format("bulk modulus {:.2f} GPa", run.bulk_modulus_Pa.value_or(0) * 1e-9)
          : fmt::format("peak {:.2f} MPa at strain {:.5f}", run.peak_stress_Pa.value_or(0) * 1e-6,
                        run.strain_at_peak.value_or(0));
  return fmt::format("{}: {}, {} steps in {:.1f} s ({:.0f} Mbond/s)", title_of(c, k), what, run.steps,
                     run.run_time_s, run.bond_updates_per_s.value_or(0) * 1e-6);
}

}  // namespace

void run_test_program(const CommandLine& line) {
  const Case c = load_case(line.case_file, line.sets, line.program);
  Progress progress = make_progress(line.quiet);
  const Features asked = asked_features(c);
  const ReadySpecimen ready = make_ready(c, line.program, asked, line.threads, progress);
  const WorldOptions options = world_options(c, line.program, asked, line.threads);
  if (line.explain || line.dry_run) {
    const World w = make_world(ready.assembly, c.materials.front(), ready.factor, options);
    say(progress, step_line(w, c.safety));
    if (const std::string elastic = describe_elasticity(c, ready, line.threads); !elastic.empty())
      say(progress, elastic);
    if (line.explain) say(progress, "\n" + explain(w));
    return;
  }

  begin_results();
  claim_run_folder(line.out, line.force);
  write_aside(line.out / "case.toml", c.resolved);
  if (c.frames > 0) create_results(line.out / "results.h5", c.resolved);
  SeriesSummary series;
  series.test = line.program;
  series.version = BRECCIA_VERSION;
  series.threads = line.threads;
  for (std::size_t k = 0; k < c.test.confinement.size() && !interrupted(); ++k) {
    World w = make_world(ready.assembly, c.materials[k], ready.factor, options);
    if (k == 0) say(progress, step_line(w, c.safety));
    series.runs.push_back(run_one(c, line.program, k, w, ready.assembly, line.out, progress));
    fit_peaks(series);
    write_summary(line.out / "summary.json", series);
    say(progress, result_line(c, k, line.program, series.runs.back()));
  }
  say(progress, "\n" + format_summary_table(series, line.out));
}

}  // namespace breccia
