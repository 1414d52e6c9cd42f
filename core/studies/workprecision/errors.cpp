#include "core/studies/workprecision/errors.hpp"

#include <algorithm>
#include <cmath>

namespace breccia {
namespace {

constexpr std::size_t curve_points = 400;  ///< at which two curves are compared

/// Strain at the k-th of the points that halve a range into equal parts: middles, so that none
/// counts half.
double middle_of(double range, std::size_t k) {
  return range * (static_cast<double>(k) + 0.5) / static_cast<double>(curve_points);
}

}  // namespace

StressStrain rising_curve(std::span<const CurveRow> rows) {
  StressStrain curve{{0.0}, {0.0}};
  for (const CurveRow& row : rows) {
    if (!(row.axial_strain > curve.strain.back())) continue;
    curve.strain.push_back(row.axial_strain);
    curve.stress.push_back(row.axial_stress_Pa - row.confining_stress_Pa);
  }
  return curve;
}

StressStrain thinned(const StressStrain& curve, std::size_t points) {
  if (curve.strain.size() <= points) return curve;
  StressStrain thin;
  for (std::size_t k = 0; k < points; ++k) {
    thin.strain.push_back(curve.strain.back() * static_cast<double>(k) / static_cast<double>(points - 1));
    thin.stress.push_back(stress_at(curve, thin.strain.back()));
  }
  return thin;
}

double stress_at(const StressStrain& c, double strain) {
  const auto above = std::upper_bound(c.strain.begin(), c.strain.end(), strain);
  if (above == c.strain.end()) return c.stress.empty() ? 0.0 : c.stress.back();
  const auto k = static_cast<std::size_t>(above - c.strain.begin());
  const double from = k ? c.strain[k - 1] : 0.0, low = k ? c.stress[k - 1] : 0.0;
  return low + (c.stress[k] - low) * (strain - from) / (c.strain[k] - from);
}

std::string_view name_of(Measure measure) {
  switch (measure) {
    case Measure::peak:
      return "peak";
    case Measure::young:
      return "young";
    case Measure::strain_at_peak:
      return "strain_at_peak";
    case Measure::curve:
      return "curve";
  }
  return "?";
}

double curve_error(const StressStrain& curve, const Readings& reference) {
  if (curve.strain.size() < 2) return Readings::none;
  double square = 0;
  for (std::size_t k = 0; k < curve_points; ++k) {
    const double strain = middle_of(reference.strain_at_peak, k);
    square += std::pow(stress_at(curve, strain) - stress_at(reference.curve, strain), 2);
  }
  return std::sqrt(square / static_cast<double>(curve_points)) / reference.peak;
}

Errors errors_of(const Readings& run, const Readings& reference) {
  return {run.peak / reference.peak - 1.0, run.young / reference.young - 1.0,
          run.strain_at_peak / reference.strain_at_peak - 1.0, curve_error(run.curve, reference)};
}

Readings mean_of(std::span<const Readings> runs) {
  const double one = 1.0 / static_cast<double>(runs.size());
  Readings mean{0, 0, 0, {}};
  for (const Readings& run : runs) {
    mean.peak += one * run.peak;
    mean.young += one * run.young;
    mean.strain_at_peak += one * run.strain_at_peak;
  }
  for (std::size_t k = 0; k <= curve_points; ++k) {
    const double strain = mean.strain_at_peak * static_cast<double>(k) / static_cast<double>(curve_points);
    double stress = 0;
    for (const Readings& run : runs) stress += one * stress_at(run.curve, strain);
    mean.curve.strain.push_back(strain);
    mean.curve.stress.push_back(stress);
  }
  return mean;
}

Errors spread_about(const Readings& mean, std::span<const Readings> runs) {
  Errors square{};
  for (const Readings& run : runs) {
    const Errors e = errors_of(run, mean);
    for (std::size_t m = 0; m < e.size(); ++m) square[m] += e[m] * e[m];
  }
  for (double& s : square) s = std::sqrt(s / static_cast<double>(runs.size() - 1));
  return square;
}

}  // namespace breccia
