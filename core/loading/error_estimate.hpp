// How far a peak may be from the one of a slow test in small steps on all packings of its kind,
// told from the run itself. The factors were measured: data/validation/error-and-stability.md.
#pragma once
#include <cstdint>
#include <optional>

namespace breccia {

/// Fractions of the peak.
struct ErrorEstimate {
  double rate = 0;             ///< because the platens do not stand still: too high by about so much
  std::optional<double> step;  ///< what the energy ledger is out by; nothing without a ledger
  double sampling = 0;         ///< one standard deviation over packings of as many spheres
};

/// @param kinetic_ratio    kinetic over stored energy, largest from half the peak to the peak
/// @param platen_mismatch  of the peak, largest up to it
/// @param energy_error     of the work put in
ErrorEstimate estimate_error(double kinetic_ratio, double platen_mismatch, std::optional<double> energy_error,
                             std::uint64_t particles);

}  // namespace breccia
