// The command line of breccia-stability, checked.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/studies/stability/run.hpp"

namespace breccia {

struct StabilityOptions {
  std::vector<std::string> only;  ///< scenes; empty: all but the long one
  bool list = false, with_long = false;
  StabilityLength length;
  int threads = 1;  ///< runs at once
  std::filesystem::path out = "out/stability";
  bool force = false, quiet = false;
};

/// @param options  filled with what the command line says
/// @returns nothing when the study is to run; else the exit code
std::optional<int> read_stability_options(int argc, char** argv, StabilityOptions& options);

/// Those asked for, in their order.
std::vector<const StabilityScene*> chosen_scenes(const StabilityOptions& options);

}  // namespace breccia
