#include "core/loading/error_estimate.hpp"

#include <cmath>

namespace breccia {
namespace {

/// Excess of the peak over the kinetic ratio: 3 at 0.1 m/s, 8 to 12 from 0.2 to 0.5 m/s.
constexpr double excess_per_kinetic_ratio = 10.0;

/// Standard deviation of the peak over packings, times the root of their number of spheres.
constexpr double scatter_of_packings = 1.6;

}  // namespace

ErrorEstimate estimate_error(double kinetic_ratio, double platen_mismatch, std::optional<double> energy_error,
                             std::uint64_t particles) {
  ErrorEstimate e;
  // the stress is the mean of both platens, so that half of what they differ by is in doubt
  e.rate = excess_per_kinetic_ratio * kinetic_ratio + 0.5 * platen_mismatch;  // (B98)
  // (B99)
  e.step = energy_error;
  e.sampling = scatter_of_packings / std::sqrt(static_cast<double>(particles));  // (B100)
  return e;
}

}  // namespace breccia
