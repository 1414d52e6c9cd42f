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
  Both<ByteCount> bytes;
  std::vector<LayoutResult> results;  ///< production first
};

/// The first of its precision.
const LayoutResult& production(const LayoutsGroup& group, Precision precision);

struct LayoutsResults {
  Machine machine;
  std::string material;
  LayoutTiming timing;
  Both<OperationCount> operations;
  std::vector<LayoutsGroup> groups;
};

/// @throws WriteError
void write_layouts_csv(const std::filesystem::path& file, const LayoutsResults& results);
void write_layouts_json(const std::filesystem::path& file, const LayoutsResults& results);

/// What the study is made of, before it runs.
std::string layouts_heading(const LayoutsResults& results);

/// A line with the limits for each precision, and a table with a row for each layout.
std::string format_layouts_group(const LayoutsGroup& group, const Both<OperationCount>& operations);

}  // namespace breccia
