#include "drivers/studies/scaling/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <string>

#include "core/base/error.hpp"
#include "drivers/programs/command_line.hpp"
#include "drivers/studies/study_options.hpp"
#include "io/text/suggest.hpp"

namespace breccia {
namespace {

constexpr std::size_t fewest_spheres = 100, most_spheres = 100'000'000;

template <class Value>
struct Word {
  std::string_view word;
  Value value;
};
constexpr std::array<Word<ScalingStudy>, 2> studies{
    {{"strong", ScalingStudy::strong}, {"weak", ScalingStudy::weak}}};
constexpr Word<ScatterKind> word_of(ScatterKind kind) { return {name_of(kind), kind}; }
constexpr std::array<Word<ScatterKind>, 3> scatters{
    word_of(ScatterKind::private_sums), word_of(ScatterKind::gather), word_of(ScatterKind::atomic)};

constexpr Word<Precision> word_of(Precision precision) { return {name_of(precision), precision}; }
constexpr std::array<Word<Precision>, 2> precisions{word_of(Precision::single), word_of(Precision::full)};

template <class Words, class Value>
std::string_view word_for(const Words& words, Value value) {
  return std::find_if(words.begin(), words.end(), [&](const auto& w) { return w.value == value; })->word;
}

/// The value of a word that `one_of` has let through.
template <class Words>
auto value_of(const Words& words, const std::string& word) {
  return std::find_if(words.begin(), words.end(), [&](const auto& w) { return w.word == word; })->value;
}

/// Lets the words through, and names the one meant for any other.
template <class Words>
CLI::Validator one_of(const Words& words) {
  std::vector<std::string> valid;
  for (const auto& w : words) valid.emplace_back(w.word);
  return CLI::Validator(
      [valid](const std::string& word) {
        if (std::find(valid.begin(), valid.end(), word) != valid.end()) return std::string();
        return fmt::format("{}: {}", quote(word), suggest(word, valid));
      },
      "");
}

/// Blocks end where a row of the curve does.
std::string check_rows(const std::string& text) {
  constexpr std::size_t row = ScalingBlocks::steps_per_row;
  std::size_t steps = 0;
  if (!CLI::detail::lexical_cast(text, steps) || steps == 0)
    return fmt::format("{} is not a number of steps from {}", quote(text), row);
  if (steps % row == 0) return "";
  const std::size_t below = steps / row * row;
  const std::string nearest =
      below ? fmt::format("{} or {}", below, below + row) : fmt::format("{}", below + row);
  return fmt::format("{} is not a multiple of {}; nearest: {}", steps, row, nearest);
}

const std::string about =
    "How the time of a step changes with the number of threads: uniaxial compression of a packed concrete "
    "cylinder\nwith the whole Dempack law, measured in blocks of steps, beside the run times that its "
    "authors "
    "have published.";

const std::string results = R"(
strong scaling: the same specimen on more threads; weak scaling: as many spheres for each thread.
Each point is a test from rest: warm-up, then blocks of steps whose wall times are taken.

DIR/scaling.csv   a line for each point: median, least and most seconds per step, nanoseconds per bond, bond
                  updates per second, speed-up and efficiency over the fewest threads, shares of the phases
                  of a step, bytes of all tables (spheres, bonds, contacts) per bond, largest resident memory;
                  under mpirun rows that a rank gets from others at every step, and how uneven its bonds are
DIR/scaling.json  the same with every block, the machine, and the published times
`scripts/plot DIR` draws them. `mpirun -n 2 breccia-scaling --threads 1` measures the same on ranks. Threads are not bound to cores: put taskset or numactl in front for that.)";

}  // namespace

std::string_view name_of(ScalingStudy study) { return word_for(studies, study); }

std::optional<int> read_scaling_options(int argc, char** argv, ScalingOptions& o) {
  CLI::App app(about, "breccia-scaling");
  o.threads = doubling(available_cores());
  std::vector<std::string> scatter{"private"}, precision{"single"};
  std::string only;
  const CLI::Range spheres(fewest_spheres, most_spheres,
                           fmt::format("{} to {}", fewest_spheres, most_spheres));
  // lists are one word with commas, so that what follows is not taken for their next value
  const auto list = [&](const std::string& name, auto& values, const std::string& meaning) {
    return app.add_option(name, values, meaning)->delimiter(',')->allow_extra_args(false);
  };
  app.set_version_flag("--version", std::string(BRECCIA_VERSION));
  list("--spheres", o.spheres, fmt::format("of strong scaling [{}]", fmt::join(o.spheres, ",")))
      ->type_name("N,N...")
      ->check(spheres);
  app.add_option("--spheres-per-thread", o.spheres_per_thread,
                 fmt::format("of weak scaling [{}]", o.spheres_per_thread))
      ->type_name("N")
      ->check(spheres);
  list("--threads", o.threads, fmt::format("[{} here]", fmt::join(o.threads, ",")))
      ->type_name("N,N...")
      ->check(CLI::Range(1, 4096, "1 to 4096"));
  list("--scatter", scatter, "how forces on shared spheres are summed: private, gather, atomic [private]")
      ->type_name("WORD,WORD...")
      ->check(one_of(scatters));
  list("--precision", precision, "of the loop over bonds: single, double [single]")
      ->type_name("WORD,WORD...")
      ->check(one_of(precisions));
  app.add_option("--only", only, "one study: strong, weak [both]")->type_name("WORD")->check(one_of(studies));
  app.add_option("--steps", o.blocks.steps,
                 fmt::format("time steps in a block, a multiple of {} [{}]", ScalingBlocks::steps_per_row,
                             o.blocks.steps))
      ->type_name("N")
      ->check(check_rows);
  app.add_option("--repeat", o.blocks.repeat, fmt::format("blocks of a point [{}]", o.blocks.repeat))
      ->type_name("N")
      ->check(CLI::Range(1, 1000, "1 to 1000"));
  app.add_option("--warm-up", o.blocks.warm_up,
                 fmt::format("time steps before the first block, a multiple of {} [{}]",
                             ScalingBlocks::steps_per_row, o.blocks.warm_up))
      ->type_name("N")
      ->check(check_rows);
  add_results_options(app, o.out, o.force, o.quiet);
  app.footer(results);
  if (const auto code = read_command_line(app, argc, argv)) return code;

  sort_unique(o.spheres);
  sort_unique(o.threads);
  o.scatter.clear();
  for (const std::string& word : scatter)
    if (const ScatterKind kind = value_of(scatters, word);
        std::find(o.scatter.begin(), o.scatter.end(), kind) == o.scatter.end())
      o.scatter.push_back(kind);
  o.precision.clear();
  for (const Word<Precision>& one : precisions)
    if (std::find(precision.begin(), precision.end(), one.word) != precision.end())
      o.precision.push_back(one.value);
  if (!only.empty()) o.only = value_of(studies, only);
  return std::nullopt;
}

std::vector<ScalingPoint> scaling_points(const ScalingOptions& o, int ranks) {
  if (o.blocks.all_steps() > ScalingBlocks::most_steps)
    fail<BadInput>("--steps: {} blocks of {} and the warm-up are {} steps; at most {}, while the test lasts",
                   o.blocks.repeat, o.blocks.steps, o.blocks.all_steps(), ScalingBlocks::most_steps);
  // what single precision sums is the same in any order: it has no gather
  std::vector<std::pair<Precision, ScatterKind>> ways;
  for (const Precision precision : o.precision)
    for (const ScatterKind scatter : o.scatter)
      if (precision == Precision::full || scatter != ScatterKind::gather)
        ways.emplace_back(precision, scatter);
  if (ways.empty())
    fail<BadInput>("--scatter: gather is a way of doubles; take --precision double, or private or atomic");
  std::vector<ScalingPoint> points;
  if (o.only != ScalingStudy::weak)
    for (const std::size_t spheres : o.spheres)
      for (const auto& [precision, scatter] : ways)
        for (const int threads : o.threads)
          points.push_back({ScalingStudy::strong, scatter, threads, spheres, precision});
  if (o.only == ScalingStudy::strong) return points;
  for (const int threads : o.threads) {
    const std::size_t all_threads = static_cast<std::size_t>(threads) * static_cast<std::size_t>(ranks);
    const std::size_t spheres = o.spheres_per_thread * all_threads;
    if (spheres > most_spheres)
      fail<BadInput>("--spheres-per-thread: {} on {} threads are {} spheres; at most {} on that many",
                     o.spheres_per_thread, all_threads, spheres, most_spheres / all_threads);
    for (const auto& [precision, scatter] : ways)
      points.push_back({ScalingStudy::weak, scatter, threads, spheres, precision});
  }
  return points;
}

}  // namespace breccia
