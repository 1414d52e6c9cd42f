// The recipes that breccia-workprecision tries: variations of one thing at a time around a base, a
// chosen set of combinations, and specimens of other sizes. The values are a table at the top of
// grid.cpp.
#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "core/studies/workprecision/recipe.hpp"

namespace breccia {

/// What sets a recipe apart from the base; sizes: the specimen, not the recipe.
enum class Family { base, step, speed, mass, scheme, damping, precision, scatter, combinations, sizes };

std::string_view name_of(Family family);
/// In the order in which they are run.
std::span<const Family> all_families();

struct Combination {
  double safety, platen_speed;
  DampingScheme scheme;
  double mass_factor;
};

struct Grid {
  double reference_safety, reference_speed;  ///< step over the critical one; m/s
  int shakes;                                ///< runs of the reference that differ by a perturbation
  double shake_size;                         ///< of every coordinate, relative
  std::vector<double> steps, speeds, masses, dampings;  ///< masses: factors of the total mass
  std::vector<DampingScheme> schemes;
  std::vector<Precision> precisions;
  std::vector<ScatterKind> scatters;
  std::vector<Combination> combinations;
  std::vector<std::size_t> spheres;  ///< of specimens packed with several seeds
  int seeds;
  std::size_t large;                 ///< spheres of one specimen run with three recipes; 0: none
  std::vector<double> large_speeds;  ///< m/s, the three
};

enum class GridSize { small, full };
const Grid& grid_of(GridSize size);

struct GridRecipe {
  Family family = Family::base;
  Recipe recipe;
};

/// The base, then the families asked for; a recipe that has come already is left out.
std::vector<GridRecipe> grid_recipes(const Grid& grid, const Recipe& base,
                                     const std::vector<Family>& families);

}  // namespace breccia
