// The command line of breccia-layouts, checked.
#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include "core/studies/layouts/layout_study.hpp"

namespace breccia {

struct LayoutsOptions {
  std::vector<std::size_t> spheres{500, 2000, 14000, 66000};  ///< rising; from the nearest cache to memory
  std::vector<int> threads;                                   ///< rising
  LayoutTiming timing;
  std::filesystem::path out = "out/layouts";
  bool force = false, quiet = false;
};

/// @param options  filled with what the command line says
/// @returns nothing when the study is to run; else the exit code
std::optional<int> read_layouts_options(int argc, char** argv, LayoutsOptions& options);

}  // namespace breccia
