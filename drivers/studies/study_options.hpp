// What the command lines of the studies have in common.
#pragma once
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "kernels/laws/material.hpp"

namespace CLI {
class App;
}

namespace breccia {

/// 1, 2, 4, ... below `cores`, and `cores`.
std::vector<int> doubling(int cores);

template <class T>
void sort_unique(std::vector<T>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// --out, --force and --quiet.
void add_results_options(CLI::App& app, std::filesystem::path& out, bool& force, bool& quiet);

/// A preset as it is shipped: one of the same name in the folder where the user is does not count.
/// @param program  its whole name, for messages
Material shipped_material(const std::string& name, const std::string& program);

}  // namespace breccia
