#include "core/studies/workprecision/sampling.hpp"

#include <array>
#include <cmath>
#include <numeric>

namespace breccia {

double mean_value(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double standard_deviation(std::span<const double> values) {
  const double mean = mean_value(values);
  double square = 0;
  for (const double v : values) square += (v - mean) * (v - mean);
  return std::sqrt(square / static_cast<double>(values.size() - 1));
}

std::optional<SpreadFit> fit_spread(std::span<const SampleGroup> groups) {
  // the variance of ln s is 1/(2 (k - 1)) for k values of a normal distribution
  double weight = 0, mx = 0, my = 0, xx = 0, xy = 0, half = 0;
  std::vector<std::array<double, 3>> points;
  for (const SampleGroup& group : groups) {
    if (group.values.size() < 2) continue;
    const double spread = standard_deviation(group.values);
    if (spread > 0)
      points.push_back(
          {std::log(group.spheres), std::log(spread), static_cast<double>(group.values.size() - 1)});
  }
  for (const auto& [x, y, w] : points) weight += w, mx += w * x, my += w * y, half += w * (y + 0.5 * x);
  mx /= weight, my /= weight;
  for (const auto& [x, y, w] : points) xx += w * (x - mx) * (x - mx), xy += w * (x - mx) * (y - my);
  if (points.size() < 2 || !(xx > 0)) return std::nullopt;
  const double exponent = xy / xx;
  return SpreadFit{std::exp(my - exponent * mx), exponent, std::exp(half / weight)};
}

}  // namespace breccia
