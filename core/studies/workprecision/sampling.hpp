// What the number of spheres does to a result: specimens of the same size and different seeds.
#pragma once
#include <optional>
#include <span>
#include <vector>

namespace breccia {

/// Results of specimens that differ by their seed alone.
struct SampleGroup {
  double spheres = 0;
  std::vector<double> values;  ///< relative errors
};

double mean_value(std::span<const double> values);
/// @param values  two or more
double standard_deviation(std::span<const double> values);

/// spread = factor n^exponent; for independent grains the exponent would be -1/2.
struct SpreadFit {
  double factor = 0, exponent = 0;
  double factor_half = 0;  ///< with the exponent held at -1/2
};

/// Least squares of ln spread over ln n, groups weighted by their degrees of freedom.
/// @returns nothing for fewer than two numbers of spheres with two seeds or more
std::optional<SpreadFit> fit_spread(std::span<const SampleGroup> groups);

}  // namespace breccia
