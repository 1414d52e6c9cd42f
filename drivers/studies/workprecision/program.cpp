#include "drivers/studies/workprecision/program.hpp"

#include <fmt/format.h>

#include <cmath>
#include <mutex>

#include "core/base/error.hpp"
#include "core/base/hold.hpp"
#include "drivers/programs/command_line.hpp"
#include "drivers/programs/signals.hpp"
#include "drivers/studies/workprecision/journal.hpp"
#include "drivers/studies/workprecision/options.hpp"
#include "drivers/studies/workprecision/results.hpp"
#include "drivers/studies/workprecision/runs.hpp"
#include "io/files/atomic_write.hpp"
#include "io/files/run_folder.hpp"
#include "io/results/progress.hpp"

namespace breccia {
namespace {

std::string heading(const WorkPrecisionResults& r, const Case& c, std::size_t trials) {
  const Machine& m = r.machine;
  std::string text = fmt::format(
      "{} runs of breccia-{}; the case's recipe: {}\n{}, {} of {} cores, {}, {}; load average {:.2f}", trials,
      r.test, describe(r.base), m.cpu, m.cores, m.cores_online, m.instruction_set, m.compiler,
      m.load_average);
  if (c.test.confinement.size() > 1)
    text += fmt::format(
        "\nonly the first of {} confinements is run: {:.4g} MPa; name another with --set "
        "test.confinement",
        c.test.confinement.size(), r.confinement * 1e-6);
  if (!has_single_loop(c)) text += "\nsingle precision is not built for the bonds of this case: left out";
  if (r.threads > m.cores) text += fmt::format("\nwarning: {} threads share {} cores", r.threads, m.cores);
  return text;
}

/// How long a trial takes beside a run of the case on all threads. Steps and spheres alone,
/// n^(4/3): more of them, and smaller ones. What a run on one thread costs more, as many at a time
/// win back.
double cost_of(const Trial& trial, const Recipe& base, double spheres) {
  const double size = trial.spheres ? static_cast<double>(trial.spheres) / spheres : 1.0;
  return steps_over(trial.recipe, base) * std::pow(size, 4.0 / 3.0);
}

std::string format_plan(const std::vector<Trial>& trials, const Recipe& base, double spheres) {
  std::string text;
  double all = 0;
  for (const Trial& trial : trials) {
    const double cost = cost_of(trial, base, spheres);
    all += cost;
    text += fmt::format("{:>10}  {:>12}  {:8.2f}  {}\n", name_of(trial.purpose), name_of(trial.family), cost,
                        key_of(trial));
  }
  return text + fmt::format("{} runs, about as long as {:.0f} of the case", trials.size(), all);
}

/// The study while it runs: every trial that ends goes to the journal and to the files.
class Study {
public:
  Study(const WorkPrecisionOptions& options, const StudyScene& scene, const std::vector<Trial>& trials,
        WorkPrecisionResults& results, Journal& journal, Progress& progress)
      : options_(options),
        scene_(scene),
        trials_(trials),
        results_(results),
        journal_(journal),
        progress_(progress) {}

  void run() {
    collect();
    // the reference first: all errors are against it
    run_untimed({Purpose::reference, Purpose::half_step, Purpose::half_speed});
    run_timed(Purpose::recipe);
    run_untimed({Purpose::size});
    run_timed(Purpose::size);
  }

private:
  /// Trials not yet done.
  std::vector<std::size_t> waiting(std::initializer_list<Purpose> purposes, bool timed) const {
    std::vector<std::size_t> found;
    for (std::size_t k = 0; k < trials_.size(); ++k)
      for (const Purpose purpose : purposes)
        if (trials_[k].purpose == purpose && trials_[k].timed == timed && !journal_.find(key_of(trials_[k])))
          found.push_back(k);
    return found;
  }

  void run_untimed(std::initializer_list<Purpose> purposes) {
    const std::vector<std::size_t> todo = waiting(purposes, false);
    if (!todo.empty())
      say(progress_, fmt::format("{} runs on one thread each, {} at a time", todo.size(), options_.threads));
    run_side_by_side(todo.size(), options_.threads, interrupted, [&](std::size_t k) {
      const Trial& trial = trials_[todo[k]];
      const auto outcome =
          trial.spheres ? run_trial(scene_, pack_for_trial(scene_, trial), trial, interrupted)
                        : run_trial(scene_, scene_.ready.at(trial.recipe.precision), trial, interrupted);
      const std::lock_guard lock(guard_);
      keep(trial, outcome);
    });
  }

  void run_timed(Purpose purpose) {
    ReadySpecimen packed;
    const Trial* packed_for = nullptr;
    for (const std::size_t k : waiting({purpose}, true)) {
      if (interrupted()) return;
      const Trial& trial = trials_[k];
      if (trial.spheres &&
          !(packed_for && packed_for->spheres == trial.spheres && packed_for->seed == trial.seed &&
            packed_for->recipe.precision == trial.recipe.precision)) {
        packed = pack_for_trial(scene_, trial);
        packed_for = &trial;
      }
      begin(progress_, describe(trial.recipe));
      keep(trial,
           run_trial(scene_, trial.spheres ? packed : scene_.ready.at(trial.recipe.precision), trial,
                     interrupted, [&](const World& w, int stage, double fraction, const CurveRow& row) {
                       tell(progress_, w, stage, fraction, row);
                     }));
    }
  }

  void keep(const Trial& trial, const std::optional<Outcome>& outcome) {
    if (!outcome) return;
    journal_.add(key_of(trial), *outcome);
    collect();
    hold_at(HoldPoint::measurement);
    say(progress_, fmt::format("{} of {}, {}", results_.runs.size(), trials_.size(),
                               describe({trial, *outcome}, results_.analysis)));
  }

  /// All that is done, in the order of the plan, and what it comes to.
  void collect() {
    results_.runs.clear();
    for (const Trial& trial : trials_)
      if (const Outcome* outcome = journal_.find(key_of(trial))) results_.runs.push_back({trial, *outcome});
    if (results_.runs.empty()) return;
    results_.analysis = analyse(results_.runs);
    write_workprecision_csv(options_.out / "workprecision.csv", results_);
    write_workprecision_json(options_.out / "workprecision.json", results_);
  }

  const WorkPrecisionOptions& options_;
  const StudyScene& scene_;
  const std::vector<Trial>& trials_;
  WorkPrecisionResults& results_;
  Journal& journal_;
  Progress& progress_;
  std::mutex guard_;
};

void run_study(const WorkPrecisionOptions& options) {
  const std::string test = test_of_case(options.case_file, options.sets);
  const Case c = load_case(options.case_file, options.sets, test);
  if (!c.groups.empty())
    fail<BadInput>("{}: material.group: a study of work and precision has one material; leave it out",
                   c.groups.front().place);
  Progress progress = make_progress(options.quiet);
  WorkPrecisionResults results;
  results.machine = describe_machine();
  results.case_file = options.case_file.string();
  results.case_hash = hash_of_case(c);
  results.test = test;
  results.confinement = c.test.confinement.front();
  results.threads = options.threads;
  results.base = recipe_of(c);
  const std::vector<Trial> trials =
      plan_trials({options.grid, results.base, options.families, options.threads, has_single_loop(c)});
  say(progress, heading(results, c, trials.size()));
  FolderLock lock;
  const bool same = is_resolved_already(options.out, c.source, c.resolved);
  if (!options.dry_run) {
    FolderUse use{{"runs.jsonl", "workprecision.csv", "workprecision.json"}, c.inputs};
    if (!same) use.writes.emplace_back("case.toml");
    lock = claim_run_folder(options.out,
                            options.resume  ? Old::keep
                            : options.force ? Old::replace
                                            : Old::refuse,
                            use);
  }
  const StudyScene scene = make_study_scene(c, test, trials, options.threads, progress);
  if (options.dry_run) {
    const auto& own = scene.ready.begin()->second.assembly.particles;
    say(progress, format_plan(trials, results.base, static_cast<double>(own.size)));
    return;
  }
  begin_results();
  Journal journal(options.out / "runs.jsonl",
                  {{"study", "workprecision"},
                   {"version", results.machine.version},
                   {"case", results.case_hash},
                   {"cpu", results.machine.cpu},
                   {"instruction set", results.machine.instruction_set}},
                  options.resume);
  if (!same) atomic_write(options.out / "case.toml", c.resolved);
  Study(options, scene, trials, results, journal, progress).run();
  say(progress,
      format_reference(results) + format_recipes(results) + format_sizes(results) + format_cheapest(results));
  if (results.analysis)
    for (const std::string& warning : results.analysis->warnings) say(progress, "warning: " + warning);
  if (interrupted())
    say(progress, fmt::format("interrupted: {} of {} runs are done; --resume goes on", results.runs.size(),
                              trials.size()));
  say(progress, fmt::format("written: {}, {}", (options.out / "workprecision.csv").string(),
                            (options.out / "workprecision.json").string()));
}

}  // namespace

int run_workprecision_program(int argc, char** argv) {
  WorkPrecisionOptions options;
  if (const auto code = read_workprecision_options(argc, argv, options)) return *code;
  return run_body("breccia-workprecision", options.threads, [&] { run_study(options); });
}

}  // namespace breccia
