// What breccia-workprecision leaves and shows: workprecision.csv, workprecision.json, tables on the
// terminal.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/studies/workprecision/analysis.hpp"
#include "drivers/programs/machine.hpp"

namespace breccia {

struct WorkPrecisionResults {
  Machine machine;
  std::string case_file, case_hash, test;
  double confinement = 0;  ///< Pa
  int threads = 1;
  Recipe base;
  std::vector<Finished> runs;        ///< in the order of the plan
  std::optional<Analysis> analysis;  ///< nothing before the reference is there
};

/// A line for each run; the column names say the units, a quantity without a value is an empty
/// field.
/// @throws WriteError
void write_workprecision_csv(const std::filesystem::path& file, const WorkPrecisionResults& results);

/// The same, reference, noise floor, fronts, cheapest recipes, sizes, and the machine.
/// @throws WriteError
void write_workprecision_json(const std::filesystem::path& file, const WorkPrecisionResults& results);

/// A run that has just ended, in a line.
std::string describe(const Finished& run, const std::optional<Analysis>& analysis);

/// For the terminal. Lines end with '\n'.
std::string format_reference(const WorkPrecisionResults& results);
std::string format_recipes(const WorkPrecisionResults& results);
std::string format_sizes(const WorkPrecisionResults& results);
/// The cheapest recipes: a table, and each once as lines of a case.
std::string format_cheapest(const WorkPrecisionResults& results);

}  // namespace breccia
