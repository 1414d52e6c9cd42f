#include "core/studies/workprecision/pareto.hpp"

#include <algorithm>
#include <cmath>

namespace breccia {
namespace {

/// Those that count, by rising cost; of equal cost by rising error.
std::vector<std::size_t> by_cost(std::span<const Choice> choices) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < choices.size(); ++k)
    if (!std::isnan(choices[k].cost) && !std::isnan(choices[k].error)) order.push_back(k);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const Choice &x = choices[a], &y = choices[b];
    return x.cost < y.cost || (x.cost == y.cost && x.error < y.error);
  });
  return order;
}

}  // namespace

std::vector<std::size_t> pareto_front(std::span<const Choice> choices) {
  std::vector<std::size_t> front;
  for (const std::size_t k : by_cost(choices))
    if (front.empty() || choices[k].error < choices[front.back()].error) front.push_back(k);
  return front;
}

std::optional<std::size_t> cheapest_within(std::span<const Choice> choices, double error) {
  for (const std::size_t k : by_cost(choices))
    if (choices[k].error <= error) return k;
  return std::nullopt;
}

}  // namespace breccia
