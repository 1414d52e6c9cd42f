// What `time.accuracy` stands for: recipes whose error was measured
// (data/validation/error-and-stability.md).
#pragma once
#include <span>
#include <string_view>

namespace breccia {

/// A key that a recipe sets where the case does not name it, and the value as one writes it.
struct RecipeDefault {
  std::string_view key, value;
};

/// @param word  "fast", "normal", "reference"; of "normal" every key has its usual default
std::span<const RecipeDefault> accuracy_recipe(std::string_view word);

}  // namespace breccia
