// What a work-precision study comes to: reference and its error bar, noise floor, errors, fronts,
// the cheapest recipes, sampling error.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/studies/workprecision/sampling.hpp"
#include "core/studies/workprecision/trial.hpp"

namespace breccia {

struct Reference {
  Recipe recipe;
  std::size_t runs = 0;
  Readings mean;                     ///< of runs that differ by round-off
  bool peak_reached = false;         ///< in all of them
  Errors floor{};                    ///< standard deviation of one run
  Errors half_step{}, half_speed{};  ///< against the mean; NaN until they are done
  /// The larger of the two and of floor/sqrt(runs): how well the reference itself is known
  Errors bar{};
  /// The larger of floor and bar: errors below it say nothing
  Errors resolution{};
};

/// Front of one measure, by run time and the larger of error and resolution: below it no recipe is
/// told from another. Indices into the finished runs.
struct Front {
  Measure measure;
  std::vector<std::size_t> runs;
};

/// The cheapest recipe whose error and the resolution together are within a tolerance, so that luck
/// alone does not choose it.
struct Cheapest {
  double tolerance = 0;
  std::optional<Measure> measure;  ///< nothing: all four
  std::optional<std::size_t> run;  ///< index into the finished runs
};

/// Specimens of one number of spheres, run with the base recipe.
struct SizeGroup {
  std::size_t spheres = 0, seeds = 0;
  Errors mean{}, spread{};  ///< of the errors against the reference (spread of one: NaN)
  double run_time = 0;      ///< s, mean
};

struct Analysis {
  Reference reference;
  std::vector<Errors> errors;  ///< of every finished run; NaN where it broke
  std::vector<Front> fronts;
  std::vector<Cheapest> cheapest;
  std::vector<SizeGroup> sizes;  ///< rising
  std::array<std::optional<SpreadFit>, all_measures.size()> fits;
  std::vector<std::string> warnings;  ///< one line each
};

/// @returns nothing before two runs of the reference are there
/// @throws SimulationBroke when the reference broke, or has no peak to compare with
std::optional<Analysis> analyse(const std::vector<Finished>& finished);

}  // namespace breccia
