#include "io/cases/accuracy.hpp"

#include <array>

namespace breccia {
namespace {

constexpr std::array fast{RecipeDefault{"damping.scheme", "summed"}, RecipeDefault{"time.safety", "0.95"},
                          RecipeDefault{"time.mass_scaling", "true"}, RecipeDefault{"time.mass_factor", "2"},
                          RecipeDefault{"features.energy_ledger", "false"}};
constexpr std::array reference{RecipeDefault{"time.safety", "0.4"},
                               RecipeDefault{"test.platen_speed", "0.05 m/s"},
                               RecipeDefault{"run.precision", "double"}};

}  // namespace

std::span<const RecipeDefault> accuracy_recipe(std::string_view word) {
  if (word == "fast") return fast;
  if (word == "reference") return reference;
  return {};
}

}  // namespace breccia
