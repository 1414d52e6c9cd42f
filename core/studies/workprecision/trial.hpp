// One run of the study: what it is for, how it is run, what it came to.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "core/bonding/assembly.hpp"
#include "core/studies/workprecision/errors.hpp"
#include "core/studies/workprecision/grid.hpp"

namespace breccia {

/// reference: small step, slow platens, several times. half_step, half_speed: what is left of its
/// error. recipe: timed alone. size: another specimen.
enum class Purpose { reference, half_step, half_speed, recipe, size };
std::string_view name_of(Purpose purpose);

struct Trial {
  Purpose purpose = Purpose::recipe;
  Family family = Family::base;
  Recipe recipe;
  std::size_t spheres = 0;  ///< packed for this trial; 0: the case's specimen
  std::uint64_t seed = 0;   ///< of the packing
  int shake = 0;            ///< number of the perturbation; 0: none
  double shake_size = 0;    ///< of every coordinate, relative
  int threads = 1;
  bool timed = false;  ///< runs alone
};

/// Everything that the outcome depends on, in a line: trials of the same key are the same run.
std::string key_of(const Trial& trial);

struct Outcome {
  std::string failure;        ///< how the simulation broke; empty when it did not
  bool peak_reached = false;  ///< the stress came down again after its largest value
  Readings readings;
  double run_time = 0;  ///< s, wall time of the time loop
  std::uint64_t steps = 0;
  double time_step = 0, critical_time_step = 0;   ///< s
  double kinetic_ratio = 0, platen_mismatch = 0;  ///< see CurveFindings
  std::uint64_t spheres = 0, bonds = 0;
};

struct Finished {
  Trial trial;
  Outcome outcome;
};

struct PlanOptions {
  Grid grid;
  Recipe base;
  std::vector<Family> families;
  int threads = 1;     ///< of timed runs
  bool single = true;  ///< whether the bond loop of the scene is built in single precision
};

/// The reference: explicit dashpots, true masses, full precision, the base's global damping.
Recipe reference_recipe(const Grid& grid, const Recipe& base);

/// In the order in which they are run: reference and its checks, recipes, sizes. Same keys once.
std::vector<Trial> plan_trials(const PlanOptions& options);

/// The specimen with every coordinate times 1 + size u, u uniform in [-1, 1).
/// @param number  seed; 0 leaves it as it is
Assembly shaken(Assembly assembly, int number, double size);

}  // namespace breccia
