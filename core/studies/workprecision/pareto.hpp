// Which of many choices are worth making: cost against error.
#pragma once
#include <optional>
#include <span>
#include <vector>

namespace breccia {

struct Choice {
  double cost = 0, error = 0;  ///< of NaN: the choice does not count
};

/// Indices of the choices that no other beats: none is as cheap and as exact, and better in one of
/// the two. In rising cost, falling error; of equal ones the first.
std::vector<std::size_t> pareto_front(std::span<const Choice> choices);

/// Index of the cheapest with at most this error.
std::optional<std::size_t> cheapest_within(std::span<const Choice> choices, double error);

}  // namespace breccia
