// What breccia-layouts prints and writes.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/studies/layouts/layout_study.hpp"
#include "drivers/programs/machine.hpp"

namespace breccia {

/// One specimen on one number of threads.
struct LayoutsGroup {
  std::size_t spheres = 0, bonds = 0;
  int threads = 1;
  ByteCount bytes;
  std::vector<LayoutResult> results;  ///< production first
};

struct LayoutsResults {
  Machine machine;
  std::string material;
  LayoutTiming timing;
  OperationCount operations;
  std::vector<LayoutsGroup> groups;
};

/// @throws WriteError
void write_layouts_csv(const std::filesystem::path& file, const LayoutsResults& results);
void write_layouts_json(const std::filesystem::path& file, const LayoutsResults& results);

/// What the study is made of, before it runs.
std::string layouts_heading(const LayoutsResults& results);

/// A line with the limits and a table with a row for each layout.
std::string format_layouts_group(const LayoutsGroup& group, const OperationCount& operations);

}  // namespace breccia
