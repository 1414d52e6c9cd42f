// The command line of breccia-workprecision, checked.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/studies/workprecision/grid.hpp"

namespace breccia {

struct WorkPrecisionOptions {
  std::filesystem::path case_file;
  std::vector<std::string> sets;  ///< --set table.key=value
  std::filesystem::path out;      ///< --out, or out/STEM-OF-CASE-workprecision
  Grid grid;                      ///< what --grid names, changed by the other options
  std::vector<Family> families;
  int threads = 1;
  bool resume = false, force = false, quiet = false, dry_run = false;
};

/// @param options  filled with what the command line says
/// @returns nothing when the study is to run; else the exit code
std::optional<int> read_workprecision_options(int argc, char** argv, WorkPrecisionOptions& options);

}  // namespace breccia
