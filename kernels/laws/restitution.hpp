// Damping of a contact from its coefficient of restitution, and back.
// docs/model.md, "Impacts".
//
// A linear contact m u'' + c u' + k u = 0 with xi = c/(2 sqrt(m k)) that never pulls is over when
// its total force comes down to zero, still overlapping: e = exp(-(pi - 2 phi) tan phi), phi = asin
// xi (Schwager and Poeschel, Granular Matter 9, 2007). At xi = 1 that is exp(-2) = 0.135; beyond,
// phi is imaginary and, with cosh s = xi, e = exp(-2 s coth s).
//
// The Hertz contact m u'' + c u^(1/4) u' + k u^(3/2) = 0 has the same e: in s = u^(5/4) its phase
// plane is that of a linear one, v dv/ds = -(4/5)(k s + c v)/m, with xi = c/sqrt(5 m k) (Antypov
// and Elliott, Europhys. Lett. 94, 2011), and it loses its force at the same point of that plane.
#pragma once
#include <cmath>
#include <numbers>

namespace breccia {

/// Rebound speed over approach speed of a contact that never pulls. (B33)
/// @param xi  fraction of critical damping, 0 or more
inline double restitution_of_damping(double xi) {
  if (xi < 1.0) {
    const double phi = std::asin(xi);
    return std::exp(-(std::numbers::pi - 2.0 * phi) * std::tan(phi));
  }
  const double s = std::acosh(xi);
  return std::exp(s > 0.0 ? -2.0 * s / std::tanh(s) : -2.0);
}

/// The inverse: fraction of critical damping that gives a coefficient of restitution, to round-off.
/// @param e  above 0, up to 1
inline double damping_of_restitution(double e) {
  if (e >= 1.0) return 0.0;
  double low = 0.0, high = 1.0;  // restitution falls as xi grows
  while (restitution_of_damping(high) > e) low = high, high *= 2.0;
  for (;;) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) return middle;
    (restitution_of_damping(middle) > e ? low : high) = middle;
  }
}

/// The same for a contact that is over only when its surfaces part, and so pulls at the end:
/// e = exp(-pi xi/sqrt(1 - xi^2)) (S3.10) (Tsuji, Tanaka and Ishida, Powder Technol. 71, 1992, in
/// closed form).
inline double damping_of_restitution_with_pull(double e) {
  const double log = std::log(e);
  return -log / std::sqrt(log * log + std::numbers::pi * std::numbers::pi);
}

}  // namespace breccia
