// What breccia-stability prints and writes.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/studies/stability/study.hpp"
#include "drivers/programs/machine.hpp"

namespace breccia {

struct StabilityResults {
  Machine machine;
  std::string material;
  StabilityLength length;
  std::vector<std::vector<StabilityRun>> parts;  ///< of a scene and part each; empty while not yet run
};

/// A line for each run; the column names say the units. What a run does not have is an empty field.
/// @throws WriteError
void write_stability_csv(const std::filesystem::path& file, const StabilityResults& results);

/// The same as objects, null for what a run does not have, and the machine.
/// @throws WriteError
void write_stability_json(const std::filesystem::path& file, const StabilityResults& results);

/// What became of the runs of one scene and part, in a line.
std::string describe(const std::vector<StabilityRun>& runs);

/// For the terminal: a line for each run, then causes and what is amiss. Lines end with '\n'.
std::string format_stability_table(const StabilityResults& results);

/// The scenes, a line each.
std::string format_scenes();

}  // namespace breccia
