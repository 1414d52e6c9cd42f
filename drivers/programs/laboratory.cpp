#include "drivers/programs/laboratory.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>

#include "core/base/error.hpp"
#include "core/base/hold.hpp"
#include "core/distributed/distribute.hpp"
#include "core/distributed/gather.hpp"
#include "core/fields/stress.hpp"
#include "core/loading/summarise.hpp"
#include "core/world/fracture_energies.hpp"
#include "core/world/make_world.hpp"
#include "drivers/programs/command_line.hpp"
#include "drivers/programs/prepare_specimen.hpp"
#include "drivers/programs/scene_of_case.hpp"
#include "drivers/programs/signals.hpp"
#include "io/cases/changed_keys.hpp"
#include "io/files/atomic_write.hpp"
#include "io/files/digest.hpp"
#include "io/files/run_folder.hpp"
#include "io/results/checkpoint.hpp"
#include "io/results/cracks_csv.hpp"
#include "io/results/curve_csv.hpp"
#include "io/results/explain.hpp"
#include "io/results/results_h5.hpp"
#include "io/results/summary_json.hpp"
#include "io/results/vtp.hpp"
#include "io/text/text_file.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

std::string fracture_energies_line(const World& w) {
  const FractureEnergies g = fracture_energies(w);
  return fmt::format("fracture energies of the bonds, mean: G_I {:.3g}, G_II {:.3g} J/m^2", g.normal,
                     g.shear);
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
                     w.options.features.breakage ? fracture_energies_line(w) : "unbreakable bonds");
}

std::string title_of(const Case& c, std::size_t k) {
  const std::size_t runs = c.test.confinement.size();
  const std::string pressure = fmt::format("{:.4g} MPa", c.test.confinement[k] * 1e-6);
  return runs == 1 ? pressure : fmt::format("run {} of {}, {}", k + 1, runs, pressure);
}

/// Defaults that are not everybody's, and the values of a material that has a table.
std::string explain_case(const Case& c) {
  std::string text;
  if (!c.unusual.empty())
    text += fmt::format("defaults of this case\n  {}\n\n", fmt::join(c.unusual, "\n  "));
  std::string table;
  for (std::size_t k = 0; k < c.material_notes.size(); ++k) {
    const MaterialNote& note = c.material_notes[k];
    if (note.from.empty()) continue;
    table += fmt::format("  {:.4g} MPa: {}: {}{}{}\n", c.test.confinement[k] * 1e-6, note.from, note.values,
                         note.warning.empty() ? "" : "; warning: ", note.warning);
  }
  if (!table.empty()) text += "values of the material's table\n" + table + "\n";
  return text;
}

/// One run of a series and what it writes to.
struct RunOfSeries {
  const Case& c;
  const Ranks& ranks;
  const LaboratoryTest& test;
  std::size_t k = 0;
  const AreaFactor& factor;
  const fs::path& folder;
  Progress& progress;
};

/// Readies results.h5 for the frames of a run.
void begin_frames(const RunOfSeries& run, const World& w, const LoadTest& load, bool resumed) {
  const fs::path results = run.folder / "results.h5";
  const int number = static_cast<int>(run.k);
  if (run.c.frames == 0) return;
  bool fresh = false;
  if (run.ranks.is_root()) {
    std::error_code ignored;
    if (!fs::exists(results, ignored)) {
      if (run.k > 0)
        say(run.progress,
            fmt::format("{}: is not there; frames of the runs before are not made again", results.string()));
      create_results(results, run.c.resolved);
    }
    fresh = !resumed || !has_run(results, number);
  }
  if (!any(run.ranks, fresh)) return;
  const std::pair<std::string, double> attributes[] = {
      {"confinement_Pa", load.confinement}, {"alpha", w.alpha}, {"time_step_s", w.dt}};
  begin_run(results, number, attributes, w.partition, w.particles, w.bonds);
}

/// One more frame in results.h5, by all ranks, and for ParaView, by the root.
void write_frame(const RunOfSeries& run, World& w, std::size_t frame, const CurveRow& row) {
  const int number = static_cast<int>(run.k), at = static_cast<int>(frame);
  World& whole = gather_to_root(w);
  if (run.c.stress) fill_stress_columns(w);
  append_frame(run.folder / "results.h5", number, at, {w.time, w.step, row.axial_strain}, w.partition,
               w.particles, w.bonds);
  if (!run.ranks.is_root()) return;
  if (run.c.stress && !run.ranks.alone()) fill_stress_columns(whole);
  write_frame_vtp(run.folder / "frames", number, at, whole.time, whole.particles, whole.bonds);
}

/// True once in `every` seconds.
auto due_every(double every) {
  return [every, last = std::chrono::steady_clock::now()]() mutable {
    const auto now = std::chrono::steady_clock::now();
    if (std::chrono::duration<double>(now - last).count() < every) return false;
    last = now;
    return true;
  };
}

using Digests = std::vector<std::pair<std::string, std::string>>;

/// Names as seen from a folder, or as they are.
Digests digests_of(const fs::path& folder, const std::vector<fs::path>& files) {
  Digests digests;
  for (const fs::path& file : files)
    digests.emplace_back((folder.empty() ? file : file.lexically_relative(folder)).string(), sha256_of(file));
  return digests;
}

/// One run; its files are written even when it breaks off.
/// @param finished  the runs before it, for its checkpoints
/// @param state, result  of a run not begun, or from a checkpoint
RunSummary run_one(const RunOfSeries& run, World& w, const Assembly& a, const std::string& finished,
                   LoadState& state, LoadResult& result) {
  const LoadTest load = load_test(run.c, run.test, run.k, run.factor);
  begin(run.progress, title_of(run.c, run.k));
  std::optional<CrackFile> crack_file;
  if (run.ranks.is_root() && w.cracks.enabled) {
    crack_file.emplace(run.folder / fmt::format("cracks-{}.csv", run.k));
    crack_file->add(std::span(w.cracks.cracks).first(state.cracks_told));
  }
  if (!run.ranks.alone()) w = distribute(std::move(w), run.ranks);
  begin_frames(run, w, load, state.stage != Stage::not_begun);

  LoadHooks hooks;
  hooks.interrupted = interrupted;
  hooks.progress = [&](int stage, double fraction, const CurveRow& row) {
    tell(run.progress, w, stage, fraction, row);
  };
  hooks.frame = [&](World& world, std::size_t frame, const CurveRow& row) {
    write_frame(run, world, frame, row);
  };
  if (crack_file) hooks.cracks = [&](std::span<const Crack> cracks) { crack_file->add(cracks); };
  hooks.checkpoint_due = due_every(run.c.checkpoint_every);
  hooks.checkpoint = [&](World& world, const LoadState& at, const LoadResult& so_far) {
    write_checkpoint(run.folder, {run.c.resolved, run.k, finished}, world, at, so_far);
  };
  const fs::path curve = run.folder / fmt::format("curve-{}.csv", run.k);
  try {
    run_load_test(w, a, load, hooks, state, result);
  } catch (...) {
    try {
      if (run.ranks.is_root()) write_curve(curve, result.record.rows);
    } catch (const WriteError&) {  // the first trouble is the one to report
    }
    throw;
  }
  const World& whole = gather_to_root(w);
  if (!run.ranks.is_root()) return {};
  write_curve(curve, result.record.rows);
  RunSummary summary = summarise(run.test, whole, a, load, result);
  const MaterialNote& note = run.c.material_notes[run.k];
  summary.material_values = note.from;
  if (!note.warning.empty()) summary.warnings.push_back(note.warning);
  summary.files = digests_of(run.folder, {curve});
  if (crack_file) {
    // on the disk before a checkpoint of the next run calls this one finished
    flush_to_disk(crack_file->path());
    summary.files = digests_of(run.folder, {curve, crack_file->path()});
  }
  return summary;
}

/// What the summary of a run says of its specimen.
void note_specimen(const ReadySpecimen& ready, RunSummary& run) {
  run.loose_particles = ready.connection.loose;
  run.pieces = ready.connection.pieces.size();
  if (ready.factor.affine > 0.0) run.alpha_affine = ready.factor.affine;
  if (!ready.assembly.body.on_edge) run.mantle_cover = lateral_cover(ready.assembly);
  run.warnings.insert(run.warnings.begin(), ready.warnings.begin(), ready.warnings.end());
}

std::string result_line(const Case& c, std::size_t k, const LaboratoryTest& test, const RunSummary& run) {
  const std::string what =
      run.cutting_force_N
          ? fmt::format("cutting force {:.4g} N, thrust {:.4g} N, {:.3g} MJ/m^3", *run.cutting_force_N,
                        run.thrust_N.value_or(0), run.specific_energy_J_per_m3.value_or(0) * 1e-6)
      : !test.strain_ends_it
          ? fmt::format("bulk modulus {:.2f} GPa", run.bulk_modulus_Pa.value_or(0) * 1e-9)
          : fmt::format("peak {:.2f} MPa at strain {:.5f}", run.peak_stress_Pa.value_or(0) * 1e-6,
                        run.strain_at_peak.value_or(0));
  return fmt::format("{}: {}, {} steps in {:.1f} s ({:.0f} Mbond/s)", title_of(c, k), what, run.steps,
                     run.run_time_s, run.bond_updates_per_s.value_or(0) * 1e-6);
}

/// Looks at the files of finished runs, which nothing makes again.
void check_files(const fs::path& folder, const Digests& files) {
  for (const auto& [name, digest] : files) {
    std::error_code ignored;
    const fs::path file = folder / name;
    if (!fs::exists(file, ignored) || sha256_of(file) != digest)
      fail<BadInput>("{}: {} since its run was finished; put it back as it was, or run anew with --force",
                     file.string(), fs::exists(file, ignored) ? "has changed" : "has gone");
  }
}

/// What `--resume` finds in the folder of results.
struct WorkDone {
  std::optional<FoundCheckpoint> checkpoint;
  bool all = false;  ///< the series is finished
};

void refuse_changes(const fs::path& file, const std::string& before, const Case& c) {
  const std::vector<std::string> changed = changed_keys(before, c.resolved);
  if (changed.empty() && has_same_specimen(before, c.resolved)) return;
  if (changed.empty())
    fail<BadInput>("{}: has changed since {} was written; resume with it as it was, or run anew with --force",
                   c.specimen.file->string(), file.string());
  fail<BadInput>(
      "{}: the case has changed since: {}; resume with the case as it was, or run it anew with --force",
      file.string(), fmt::join(changed, "; "));
}

/// @throws BadInput when the case has changed since, naming the keys; when an input, or what has
///         been done, has
WorkDone find_work(const CommandLine& line, const Case& c, Progress& progress) {
  WorkDone work;
  if (!line.resume) return work;
  const fs::path case_file = line.out / "case.toml";
  work.checkpoint = find_checkpoint(line.out, [&](const std::string& text) { say(progress, text); });
  if (work.checkpoint) {
    refuse_changes(work.checkpoint->file, work.checkpoint->head.case_text, c);
    if (line.ranks.is_root())
      for (const RunSummary& run : read_runs(work.checkpoint->head.finished))
        check_files(line.out, run.files);
    return work;
  }
  std::error_code ignored;
  if (fs::exists(case_file, ignored)) refuse_changes(case_file, read_text(case_file), c);
  const FinishedRuns finished = finished_runs(line.out / "summary.json");
  work.all = finished.count == c.test.confinement.size();
  if (work.all && line.ranks.is_root()) check_files(line.out, finished.files);
  say(progress, work.all ? fmt::format("{}: finished, nothing to do", line.out.string())
                         : fmt::format("{}: no checkpoint, begins at the start", line.out.string()));
  return work;
}

/// What a series writes into its folder.
/// @param goes_on  from a checkpoint: the resolved case is there
std::vector<std::string> written_by(const Case& c, const CommandLine& line, bool goes_on) {
  std::vector<std::string> names{"summary.json", "checkpoint.h5", "checkpoint-before.h5"};
  if (!goes_on && !is_resolved_already(line.out, c.source, c.resolved)) names.emplace_back("case.toml");
  if (c.frames > 0) names.emplace_back("results.h5");
  for (std::size_t k = 0; k < c.test.confinement.size(); ++k) {
    names.push_back(fmt::format("curve-{}.csv", k));
    if (c.cracks) names.push_back(fmt::format("cracks-{}.csv", k));
    if (c.frames == 0) continue;
    names.push_back(fmt::format("frames/run-{}.pvd", k));
    for (const char* what : {"particles", "bonds"})
      names.push_back(fmt::format("frames/run-{}/{}-*.vtp", k, what));
  }
  return names;
}

void run_series(const LaboratoryTest& test, const CommandLine& line) {
  const Case c = load_case(line.case_file, line.sets, line.program);
  const Ranks& ranks = line.ranks;
  Progress progress = make_progress(line.quiet || !ranks.is_root());
  const bool writes = ranks.is_root() && !line.explain && !line.dry_run;
  FolderLock lock;  // before anything that another run may be changing is looked at
  if (line.resume && writes) lock = lock_folder_if_used(line.out);
  const WorkDone work = find_work(line, c, progress);
  if (work.all) return;
  const std::optional<FoundCheckpoint>& found = work.checkpoint;
  const Features asked = asked_features(c);
  const ReadySpecimen ready = make_ready(c, test, asked, line.threads, progress);
  const WorldOptions options = world_options(c, test, asked, line.threads);
  if (line.explain || line.dry_run) {
    const World w = make_world(ready.assembly, material_of_run(c, test, 0, ready.factor), ready.factor,
                               options, materials_of_groups(c, test, 0, ready.factor, ready.group_factors));
    say(progress, step_line(w, c.safety));
    if (const std::string elastic = describe_elasticity(c, test, ready, line.threads); !elastic.empty())
      say(progress, elastic);
    if (line.explain) say(progress, "\n" + explain_case(c) + explain(w));
    return;
  }

  barrier(ranks);  // until nobody reads what was there any more
  begin_results();
  const Digests inputs = ranks.is_root() ? digests_of({}, c.inputs) : Digests{};
  if (ranks.is_root()) {
    const FolderUse use{written_by(c, line, found.has_value()), c.inputs};
    const Old old = found ? Old::keep : line.force || line.resume ? Old::replace : Old::refuse;
    lock = claim_run_folder(line.out, old, use, std::move(lock));
    if (!found && !is_resolved_already(line.out, c.source, c.resolved))
      atomic_write(line.out / "case.toml", c.resolved);
    if (!found && c.frames > 0) create_results(line.out / "results.h5", c.resolved);
  }
  SeriesSummary series;
  series.test = line.program;
  series.version = BRECCIA_VERSION;
  series.threads = line.threads;
  series.ranks = ranks.count;
  series.inputs = inputs;
  if (found) series.runs = read_runs(found->head.finished);
  Stopped stopped = Stopped::strain;
  for (std::size_t k = series.runs.size(); k < c.test.confinement.size() && stopped != Stopped::interrupted;
       ++k) {
    World w = make_world(ready.assembly, material_of_run(c, test, k, ready.factor), ready.factor, options,
                         materials_of_groups(c, test, k, ready.factor, ready.group_factors));
    if (k == 0) say(progress, step_line(w, c.safety));
    LoadState state;
    LoadResult result;
    if (found && k == found->head.run) {
      read_checkpoint(*found, w, state, result);
      say(progress, fmt::format("goes on from step {} of run {} ({})", w.step, k + 1, found->file.string()));
    }
    const std::string finished = runs_text(series.runs);
    series.runs.push_back(run_one({c, ranks, test, k, ready.factor, line.out, progress}, w, ready.assembly,
                                  finished, state, result));
    note_specimen(ready, series.runs.back());
    stopped = result.stopped;
    if (!ranks.is_root()) continue;
    fit_peaks(test, series);
    write_summary(line.out / "summary.json", series);
    say(progress, result_line(c, k, test, series.runs.back()));
    hold_at(HoldPoint::run);
  }
  if (!ranks.is_root()) return;
  if (stopped != Stopped::interrupted) remove_checkpoints(line.out);
  say(progress, "\n" + format_summary_table(series, line.out));
  if (stopped == Stopped::interrupted) return say(progress, "interrupted; --resume goes on from here");
  for (const RunSummary& run : series.runs)
    if (run.stopped_by == name_of(Stopped::no_rest))
      fail<SimulationBroke>(
          "under {:.4g} MPa the specimen did not come to rest and was not loaded; see the "
          "warnings in {}",
          run.confinement_Pa * 1e-6, (line.out / "summary.json").string());
}

}  // namespace

int run_laboratory_test(std::string_view name, int argc, char** argv) {
  const LaboratoryTest& test = *find_laboratory_test(name);
  return run_program(
      std::string(name), std::string(test.about), argc, argv,
      [&](const CommandLine& line) { run_series(test, line); }, {}, true);
}

}  // namespace breccia
