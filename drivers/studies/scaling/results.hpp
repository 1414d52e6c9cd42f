// What breccia-scaling leaves and shows: scaling.csv, scaling.json, the tables on the terminal.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "drivers/programs/machine.hpp"
#include "drivers/studies/scaling/options.hpp"

namespace breccia {

struct ScalingResults {
  Machine machine;
  ScalingBlocks blocks;
  std::string material;  ///< preset
  std::vector<ScalingRun> runs;
};

/// A line for each point; the column names say the units.
/// @throws WriteError
void write_scaling_csv(const std::filesystem::path& file, const ScalingResults& results);

/// The same with every block, the machine and the published times.
/// @throws WriteError
void write_scaling_json(const std::filesystem::path& file, const ScalingResults& results);

/// One point in a line.
std::string describe(const ScalingPoint& point);
std::string describe(const ScalingRun& run, const std::vector<ScalingRun>& runs);

/// For the terminal: a table for each study, a line for each point. Lines end with '\n'.
std::string format_scaling_tables(const ScalingResults& results);

/// For the terminal: breccia beside what others have published for as many spheres and steps, and
/// the ratios. Lines end with '\n'.
std::string format_comparison(const ScalingResults& results);

}  // namespace breccia
