// How far a run is from the reference, and how far runs are from each other that ought to be equal.
#pragma once
#include <array>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/loading/curve_row.hpp"

namespace breccia {

/// Deviator over axial strain; strains rise strictly.
struct StressStrain {
  std::vector<double> strain;  ///< 1
  std::vector<double> stress;  ///< Pa
};

/// The rows whose strain is beyond all before (a gauge unloads where cracks localise elsewhere),
/// from the origin.
StressStrain rising_curve(std::span<const CurveRow> rows);

/// The same at `points` strains, evenly spaced from 0 to the last.
StressStrain thinned(const StressStrain& curve, std::size_t points);

/// Pa, straight between points; before the first from the origin, beyond the last its value.
double stress_at(const StressStrain& curve, double strain);

/// What is read off a run. NaN where it did not come so far.
struct Readings {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double peak = none;   ///< Pa, of the deviator
  double young = none;  ///< Pa, initial
  double strain_at_peak = none;
  StressStrain curve;
};

enum class Measure { peak, young, strain_at_peak, curve };
inline constexpr std::array<Measure, 4> all_measures{Measure::peak, Measure::young, Measure::strain_at_peak,
                                                     Measure::curve};
std::string_view name_of(Measure measure);

/// One number for each measure, in the order of `all_measures`. Of the reference: with sign, but
/// for the curve.
using Errors = std::array<double, all_measures.size()>;

/// Root mean square of the stress difference over the strains up to the reference's peak, over that
/// peak.
double curve_error(const StressStrain& curve, const Readings& reference);

/// (x - reference)/reference, and the curve's error.
Errors errors_of(const Readings& run, const Readings& reference);

/// Means of runs that differ by round-off; the curve's up to the mean strain at the peak.
/// @param runs  at least one, with all readings
Readings mean_of(std::span<const Readings> runs);

/// Standard deviation of one run about the mean of all, over that mean: noise that no recipe gets
/// below.
/// @param runs  two or more
Errors spread_about(const Readings& mean, std::span<const Readings> runs);

}  // namespace breccia
