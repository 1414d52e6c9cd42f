// Median and range of repeated measurements.
#pragma once
#include <algorithm>
#include <vector>

namespace breccia {

struct MedianAndRange {
  double median = 0, least = 0, most = 0;
};

/// @param values  at least one
inline MedianAndRange median_and_range_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return {0.5 * (values[(n - 1) / 2] + values[n / 2]), values.front(), values.back()};
}

}  // namespace breccia
