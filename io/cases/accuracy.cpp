#include "io/cases/accuracy.hpp"

#include <array>

namespace breccia {
namespace {

constexpr std::array fast{RecipeStandard{"damping.scheme", "summed"}, RecipeStandard{"time.safety", "0.95"},
                          RecipeStandard{"time.mass_scaling", "true"},
                          RecipeStandard{"time.mass_factor", "2"},
                          RecipeStandard{"features.energy_ledger", "false"}};
constexpr std::array reference{RecipeStandard{"time.safety", "0.4"},
                               RecipeStandard{"test.platen_speed", "0.05 m/s"}};

}  // namespace

std::span<const RecipeStandard> accuracy_recipe(std::string_view word) {
  if (word == "fast") return fast;
  if (word == "reference") return reference;
  return {};
}

}  // namespace breccia
