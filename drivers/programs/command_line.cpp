#include "drivers/programs/command_line.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <sched.h>
#include <tbb/global_control.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <thread>

#include "core/base/error.hpp"
#include "core/base/hold.hpp"
#include "drivers/programs/ending.hpp"
#include "drivers/programs/signals.hpp"
#include "io/cases/case.hpp"
#include "io/files/standard_streams.hpp"
#include "io/reference/keys_reference.hpp"
#include "io/text/message_line.hpp"

namespace breccia {
namespace {

int end(const std::string& program, std::string_view what, int code) {
  // fputs: nobody is left to be told when this line cannot be written
  std::fputs(fmt::format("{}: {}\n", program, message_line(what)).c_str(), stderr);
  return code;
}

/// Of several ranks the root speaks. Another one has something to say only when it alone is in
/// trouble: it waits for the root's word, which ends the job for all.
int end_rank(const Ranks& ranks, const std::string& program, std::string_view what, int code) {
  if (ranks.alone()) return end(program, what, code);
  if (!ranks.is_root()) {
    std::this_thread::sleep_for(std::chrono::seconds(20));  // the root may be slow
    end(fmt::format("{}, rank {}", program, ranks.rank), what, code);
  } else {
    end(program, what, code);
  }
  std::fflush(nullptr);
  mpi_abort(code);
}

}  // namespace

int available_cores() {
  cpu_set_t mask;
  CPU_ZERO(&mask);
  return sched_getaffinity(0, sizeof(mask), &mask) == 0 ? std::max(1, CPU_COUNT(&mask)) : 1;
}

std::optional<int> read_command_line(CLI::App& app, int argc, char** argv) {
  open_standard_streams();
  end_in_order(app.get_name());
  catch_signals();
  const bool speaks = ranks_of_launcher().is_root();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::ostringstream out, err;
    const int code = app.exit(error, out, err) == 0 ? 0 : 2;
    if (!speaks) return 0;  // what the job ends with is the root's, which has to come to its line first
    if (code != 0)
      return end(app.get_name(), fmt::format("{} (see {} --help)", error.what(), app.get_name()), code);
    try {
      print_out(out.str());  // --help, --version
    } catch (const WriteError& trouble) {
      return end(app.get_name(), trouble.what(), 4);
    }
    return 0;
  }
  return std::nullopt;
}

int run_body(const std::string& program, int threads, const std::function<void()>& body, bool several_ranks) {
  Ranks ranks = ranks_of_launcher();
  if (!ranks.alone() && !several_ranks)
    return ranks.is_root()
               ? end(program,
                     fmt::format("{} ranks asked for; this program runs on one (use --threads)", ranks.count),
                     2)
               : 0;  // see above
  ranks = mpi_init();
  // glibc raises this threshold when a large block is freed; columns that then come from the heap
  // lie so that integration takes twice as long
  mallopt(M_MMAP_THRESHOLD, 128 * 1024);
  try {
    try_threads(threads);
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    set_hold(std::getenv("BRECCIA_HOLD"), interrupted);
    body();
  } catch (...) {
    const Ending ending = ending_of(std::current_exception());
    return end_rank(ranks, program, ending.what, ending.code);
  }
  mpi_finalize();
  return interrupted() ? 130 : 0;
}

int run_program(const std::string& name, const std::string& about, int argc, char** argv,
                const std::function<void(const CommandLine&)>& body, const std::string& keys,
                bool several_ranks, std::string (*reference)()) {
  const std::string program = "breccia-" + name;
  CommandLine line;
  line.program = name;
  line.threads = available_cores();
  CLI::App app(about, program);
  app.set_version_flag("--version", std::string(BRECCIA_VERSION));
  app.add_option("CASE.toml", line.case_file, "the case to run")->required();
  app.add_option("--set", line.sets, "table.key=value, instead of the case's")->allow_extra_args(false);
  app.add_option("--out", line.out, "folder for the results [out/CASE]");
  app.add_option("--threads", line.threads, fmt::format("[{} here]", line.threads))
      ->check(CLI::Range(1, 4096));
  app.add_flag("--explain", line.explain, "say what the scene uses and leaves out; write nothing");
  app.add_flag("--dry-run", line.dry_run, "read, check, bond, print; write nothing");
  app.add_flag("--force", line.force, "replace results that are there");
  app.add_flag("--quiet", line.quiet, "errors only");
  app.add_flag("--resume", line.resume, "go on from the newest checkpoint in the folder of results");
  // for scripts/case-reference: left out of --help, which has the same keys
  app.add_flag_callback("--keys-markdown",
                        [reference] {
                          throw CLI::CallForVersion(reference ? reference() : case_reference(),
                                                    0);  // printed, then exit code 0
                        })
      ->group("");
  app.footer(keys.empty() ? describe_keys(name) : keys);
  if (const auto code = read_command_line(app, argc, argv)) return *code;
  if (line.out.empty()) line.out = std::filesystem::path("out") / line.case_file.stem();
  return run_body(
      program, line.threads,
      [&] {
        if (line.resume && line.force)
          fail<BadInput>(
              "--resume, --force: one keeps the results that are there, the other replaces them; give one");
        line.ranks = ranks_of_launcher();
        body(line);
      },
      several_ranks);
}

}  // namespace breccia
