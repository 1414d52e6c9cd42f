#include "io/compression_program.hpp"

#include <fmt/format.h>

#include "core/compression.hpp"
#include "core/error.hpp"
#include "core/state_hash.hpp"
#include "core/strength.hpp"
#include "io/curve.hpp"
#include "io/explain.hpp"
#include "io/ready_specimen.hpp"
#include "io/results_h5.hpp"
#include "io/run_folder.hpp"
#include "io/summary.hpp"
#include "io/vtp.hpp"
#include "io/write_aside.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

std::string name_of(Stopped stopped) {
  switch (stopped) {
    case Stopped::strain:
      return "strain";
    case Stopped::peak_drop:
      return "peak drop";
    case Stopped::interrupted:
      return "interrupted";
  }
  return "?";
}

WorldOptions world_options(const Case& c, const Features& asked, int threads) {
  WorldOptions o;
  o.features = asked;
  o.new_contacts = c.features.new_contacts;
  o.rough_platens = c.test.rough_platens;
  o.contact_damping = c.damping.contact;
  o.paper_form = c.damping.paper_form;
  o.global_damping = {c.damping.translation, c.damping.rotation};
  o.safety = c.safety;
  o.scatter = c.scatter;
  o.threads = threads;
  return o;
}

AreaFactor area_factor(const Case& c, const Assembly& assembly, int threads, Progress& progress) {
  const Material& m = c.materials.front();
  const AreaFactor f = find_area_factor(assembly,
                                        {c.bonds.alpha_rule, c.bonds.alpha, c.bonds.elasticity,
                                         m.young_modulus, m.poisson_ratio, c.test.rough_platens},
                                        threads);
  say(progress, fmt::format("alpha {:.4f} (areas tile space {:.3f} times), k_s/k_n {:.4f}{}", f.alpha,
                            f.fabric, f.shear_ratio,
                            f.probes ? fmt::format("; elastic probe: E {:.4g} GPa, nu {:.4f}",
                                                   f.young_modulus * 1e-9, f.poisson_ratio)
                                     : ""));
  return f;
}

/// Energy per area that the bonds need to part, mean over the bonds; the law's delta fixes it (MODEL section
/// 3).
std::string fracture_energies(const World& w) {
  if (!w.options.features.breakage) return "unbreakable bonds";
  double normal = 0, shear = 0;
  for (std::size_t k = 0; k < w.bonds.size; ++k) {
    const double length = w.law.young * w.bonds.area[k] / w.bonds.stiffness[k];
    const double n = w.law.tensile_strength, s = w.law.shear_strength;
    normal += 0.5 * n * n * length / w.law.young * (1.0 + delta_normal(w.law, length));
    if (w.law.shear_ratio > 0)
      shear += 0.5 * s * s * length / (w.law.shear_ratio * w.law.young) * (1.0 + delta_shear(w.law, length));
  }
  const double one = 1.0 / static_cast<double>(w.bonds.size);
  return fmt::format("fracture energies of the bonds, mean: G_I {:.3g}, G_II {:.3g} J/m^2", one * normal,
                     one * shear);
}

void warn_if_dynamic(const CurveFindings& f, RunSummary& run) {
  if (f.kinetic_ratio > 1e-3)
    run.warnings.push_back(fmt::format(
        "dynamic: kinetic over stored energy reaches {:.1e} before the peak (quasi-static: below 1e-3); "
        "lower test.platen_speed",
        f.kinetic_ratio));
  if (f.platen_mismatch > 0.02)
    run.warnings.push_back(fmt::format(
        "dynamic: the platens differ by {:.1f} % of the peak before it (quasi-static: below 2 %); "
        "lower test.platen_speed",
        100 * f.platen_mismatch));
}

RunSummary summarise(const World& w, const Assembly& a, const CompressionTest& test,
                     const CompressionResult& result) {
  const CurveFindings f = read_curve(result.record.rows, result.record.mismatch);
  RunSummary run;
  run.confinement_Pa = test.confinement;
  if (!result.record.rows.empty()) {
    run.peak_stress_Pa = f.peak_stress;
    run.peak_deviator_Pa = f.peak_deviator;
    run.strain_at_peak = f.strain_at_peak;
    run.kinetic_ratio = f.kinetic_ratio;
    run.platen_mismatch = f.platen_mismatch;
  }
  run.peak_reached = f.peak_reached;
  run.young_modulus_Pa = f.young_modulus;
  run.young_modulus_50_Pa = f.young_modulus_50;
  run.poisson_ratio = f.poisson_ratio;
  run.crack_initiation_stress_Pa = f.crack_initiation_stress;
  run.crack_damage_stress_Pa = f.crack_damage_stress;
  run.alpha = w.alpha;
  run.particles = w.particles.size;
  run.bonds = w.bonds.size;
  run.coordination = a.coordination;
  run.short_bonds = a.short_bonds;
  const BrokenCount broken = count_broken(w);
  run.broken_tension = broken.tension;
  run.broken_shear = broken.shear;
  run.steps = w.step;
  run.time_step_s = w.dt;
  run.critical_time_step_s = w.critical_dt;
  run.run_time_s = result.run_time;
  for (std::size_t k = 0; k < phase_names.size(); ++k)
    run.phases_s.emplace_back(phase_names[k], w.phases.seconds[k]);
  const double updates = static_cast<double>(w.bonds.size) * static_cast<double>(w.step);
  run.bond_updates_per_s = updates / (result.run_time - w.phases[Phase::output]);
  run.bond_pass_per_s = updates / (w.phases[Phase::bonds] + w.phases[Phase::gather]);
  run.state_hash = state_hash(w.particles, w.bonds);
  run.stopped_by = name_of(result.stopped);
  run.warnings = result.warnings;
  warn_if_dynamic(f, run);
  return run;
}

void fit_peaks(SeriesSummary& series) {
  std::vector<double> confinement, peak;
  for (const RunSummary& run : series.runs) {
    if (!run.peak_reached) continue;  // the largest stress so far is not a strength
    confinement.push_back(run.confinement_Pa);
    peak.push_back(*run.peak_stress_Pa);
  }
  series.mohr_coulomb = fit_mohr_coulomb(confinement, peak);
}

std::string title_of(const Case& c, std::size_t k) {
  const std::size_t runs = c.test.confinement.size();
  const std::string pressure = fmt::format("{:.4g} MPa", c.test.confinement[k] * 1e-6);
  return runs == 1 ? pressure : fmt::format("run {} of {}, {}", k + 1, runs, pressure);
}

/// One run; its files are written even when it breaks off.
RunSummary run_one(const Case& c, std::size_t k, World& w, const Assembly& a, const fs::path& folder,
                   Progress& progress) {
  const CompressionTest test{c.test.confinement[k], c.test.platen_speed, c.test.stop_strain,
                             c.test.stop_after_peak, c.frames};
  const int run = static_cast<int>(k);
  begin(progress, title_of(c, k));
  const std::pair<std::string, double> attributes[] = {
      {"confinement_Pa", test.confinement}, {"alpha", w.alpha}, {"time_step_s", w.dt}};
  if (c.frames > 0) begin_run(folder / "results.h5", run, attributes, w.particles, w.bonds);

  CompressionHooks hooks;
  hooks.interrupted = interrupted;
  hooks.progress = [&](int stage, double fraction, const CurveRow& row) {
    tell(progress, w, stage, fraction, row);
  };
  int frame = 0;
  hooks.frame = [&](const World& world, const CurveRow& row) {
    append_frame(folder / "results.h5", run, frame, {world.time, world.step, row.axial_strain},
                 world.particles, world.bonds);
    write_frame_vtp(folder / "frames", run, frame, world.time, world.particles, world.bonds);
    ++frame;
  };
  CompressionResult result;
  const fs::path curve = folder / fmt::format("curve-{}.csv", k);
  try {
    run_compression(w, a, test, hooks, result);
  } catch (...) {
    try {
      write_curve(curve, result.record.rows);
    } catch (const FileTrouble&) {  // the first trouble is the one to report
    }
    throw;
  }
  write_curve(curve, result.record.rows);
  return summarise(w, a, test, result);
}

}  // namespace

void run_compression_program(const CommandLine& line) {
  const Case c = load_case(line.case_file, line.sets, line.program);
  Progress progress = make_progress(line.quiet);
  const Features asked = asked_features(c);
  const Assembly assembly = make_assembly(c, built_features(asked), line.threads, progress);
  const AreaFactor factor = area_factor(c, assembly, line.threads, progress);
  const WorldOptions options = world_options(c, asked, line.threads);
  if (line.explain || line.dry_run) {
    const World w = make_world(assembly, c.materials.front(), factor, options);
    say(progress, fmt::format("step {:.4g} s, {:.3g} of the critical {:.4g} s; {}", w.dt, c.safety,
                              w.critical_dt, fracture_energies(w)));
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
    World w = make_world(assembly, c.materials[k], factor, options);
    if (k == 0)
      say(progress, fmt::format("step {:.4g} s, {:.3g} of the critical {:.4g} s; {}", w.dt, c.safety,
                                w.critical_dt, fracture_energies(w)));
    series.runs.push_back(run_one(c, k, w, assembly, line.out, progress));
    fit_peaks(series);
    write_summary(line.out / "summary.json", series);
    const RunSummary& run = series.runs.back();
    say(progress,
        fmt::format("{}: peak {:.2f} MPa at strain {:.5f}, {} steps in {:.1f} s ({:.0f} Mbond/s)",
                    title_of(c, k), run.peak_stress_Pa.value_or(0) * 1e-6, run.strain_at_peak.value_or(0),
                    run.steps, run.run_time_s, run.bond_updates_per_s.value_or(0) * 1e-6));
  }
  say(progress, "\n" + format_summary_table(series, line.out));
}

}  // namespace breccia
