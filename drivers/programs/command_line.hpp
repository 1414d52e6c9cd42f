// The command line that all programs share, and how they end.
#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/ranks/mpi.hpp"

namespace CLI {
class App;
}

namespace breccia {

struct CommandLine {
  std::string program;  ///< "triaxial"
  std::filesystem::path case_file;
  std::vector<std::string> sets;  ///< --set table.key=value
  std::filesystem::path out;      ///< --out, or out/STEM-OF-CASE
  int threads = 1;
  Ranks ranks;
  bool explain = false, dry_run = false, force = false, quiet = false, resume = false;
};

/// Cores of the affinity mask.
int available_cores();

/// Readies the process (streams, signals) and reads the words after the program's name.
/// @returns nothing when the program is to run; else its exit code, after --help, --version, or one
///          line on stderr; of several ranks the root alone speaks
std::optional<int> read_command_line(CLI::App& app, int argc, char** argv);

/// Runs `body` on at most `threads` threads and turns what it throws into one line on stderr and
/// the exit code: 0 done, 2 bad input, 3 the simulation broke, 4 files, 130 interrupted.
/// @param program  its whole name, "breccia-ucs"
/// @param several_ranks  false: more than one is refused
int run_body(const std::string& program, int threads, const std::function<void()>& body,
             bool several_ranks = false);

/// A program with a case: reads the command line and runs `body`; the exit code is that of
/// `run_body`.
/// @param about  one line for --help
/// @param keys   the reference of keys for --help; empty: describe_keys(name)
/// @param several_ranks  false: more than one is refused
/// @param reference  what --keys-markdown prints; nothing: case_reference
int run_program(const std::string& name, const std::string& about, int argc, char** argv,
                const std::function<void(const CommandLine&)>& body, const std::string& keys = {},
                bool several_ranks = false, std::string (*reference)() = nullptr);

}  // namespace breccia
