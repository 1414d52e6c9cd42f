#include "drivers/studies/layouts/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <string>

#include "drivers/programs/command_line.hpp"
#include "drivers/studies/study_options.hpp"

namespace breccia {
namespace {

const std::string about =
    "The same bonds, stored and summed in other ways: what each costs, and how far it is from what the "
    "machine can do.\nDempack law with all features on a packed concrete cylinder; nothing moves while it is "
    "timed.";

const std::string results = R"(
precision  single: bonds in blocks of 16, particles in records of 64 bytes; double
bonds      columns (production in double), records, blocks of 8 and of 16 bonds side by side
particles  records of motion and of sums (production), columns
sums       private (production), gather, atomic (shared ends only), all atomic, colours
of         what sums are made of; in single integers of 32 bits (production), of 64, or floats
The first row of a precision is its production, the others differ from it in one thing; all are held against
the forces and history of production in double.

limit      the longer of bytes/bandwidth and operations/peak, both measured in the same run: a stream over a
           set of the same size, and multiplications and additions of doubles that wait for nothing, of floats
           twice as many

DIR/layouts.csv   a line for each size, number of threads and layout: median, least and most ns per bond,
                  bonds per second, limit, difference from production
DIR/layouts.json  the same with every block, bytes and operations per bond, bandwidth, peak, the machine
`scripts/plot DIR` draws them. Threads are not bound to cores: put taskset or numactl in front for that.
Exit code 1: a layout differs by more than 1e-9, in single 1e-4: the scene is hardly loaded, and forces are
rounded to a quantum.)";

}  // namespace

std::optional<int> read_layouts_options(int argc, char** argv, LayoutsOptions& o) {
  CLI::App app(about, "breccia-layouts");
  o.threads = doubling(available_cores());
  // lists are one word with commas, so that what follows is not taken for their next value
  const auto list = [&](const std::string& name, auto& values, const std::string& meaning) {
    return app.add_option(name, values, meaning)
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("N,N...");
  };
  app.set_version_flag("--version", std::string(BRECCIA_VERSION));
  list("--spheres", o.spheres, fmt::format("in the cylinder [{}]", fmt::join(o.spheres, ",")))
      ->check(CLI::Range(std::size_t{100}, std::size_t{100'000'000}, "100 to 100000000"));
  list("--threads", o.threads, fmt::format("[{} here]", fmt::join(o.threads, ",")))
      ->check(CLI::Range(1, 4096, "1 to 4096"));
  app.add_option("--repeat", o.timing.repeat, fmt::format("blocks of passes [{}]", o.timing.repeat))
      ->type_name("N")
      ->check(CLI::Range(1, 1000, "1 to 1000"));
  app.add_option("--block", o.timing.block_seconds,
                 fmt::format("seconds that a block takes, about [{}]", o.timing.block_seconds))
      ->type_name("S")
      ->check(CLI::Range(1e-4, 60.0, "0.0001 to 60"));
  add_results_options(app, o.out, o.force, o.quiet);
  app.footer(results);
  if (const auto code = read_command_line(app, argc, argv)) return code;
  sort_unique(o.spheres);
  sort_unique(o.threads);
  return std::nullopt;
}

}  // namespace breccia
