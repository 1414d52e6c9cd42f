#include "core/strength.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace breccia {
namespace {

double deviator(const CurveRow& r) { return r.axial_stress_Pa - r.confining_stress_Pa; }

/// Least-squares slope of y over x.
template <class X, class Y>
std::optional<double> slope(std::span<const CurveRow> rows, const X& x, const Y& y) {
  if (rows.size() < 3) return {};
  double mx = 0, my = 0;
  for (const auto& r : rows) mx += x(r), my += y(r);
  mx /= static_cast<double>(rows.size()), my /= static_cast<double>(rows.size());
  double xx = 0, xy = 0;
  for (const auto& r : rows) xx += (x(r) - mx) * (x(r) - mx), xy += (x(r) - mx) * (y(r) - my);
  if (!(xx > 0)) return {};
  return xy / xx;
}

/// Rows on the way up whose deviator lies between two fractions of the peak.
std::span<const CurveRow> rising(std::span<const CurveRow> rows, std::size_t peak, double from, double to) {
  const double top = deviator(rows[peak]);
  std::size_t first = peak, last = peak;
  while (last > 0 && deviator(rows[last - 1]) > to * top) --last;
  first = last;
  while (first > 0 && deviator(rows[first - 1]) > from * top) --first;
  return rows.subspan(first, last - first);
}

}  // namespace

CurveFindings read_curve(std::span<const CurveRow> rows, std::span<const double> mismatch) {
  CurveFindings f;
  if (rows.empty()) return f;
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (deviator(rows[k]) > deviator(rows[f.peak_row])) f.peak_row = k;
  const CurveRow& peak = rows[f.peak_row];
  f.peak_stress = peak.axial_stress_Pa;
  f.peak_deviator = deviator(peak);
  f.strain_at_peak = peak.axial_strain;
  for (std::size_t k = f.peak_row; k < rows.size(); ++k)
    if (deviator(rows[k]) < 0.99 * f.peak_deviator) f.peak_reached = true;

  const auto strain = [](const CurveRow& r) { return r.axial_strain; };
  const auto initial = rising(rows, f.peak_row, 0.05, 0.25);
  f.young_modulus = slope(initial, strain, deviator);
  f.young_modulus_50 = slope(rising(rows, f.peak_row, 0.45, 0.55), strain, deviator);
  if (const auto lateral = slope(initial, strain, [](const CurveRow& r) { return r.radial_strain; }))
    f.poisson_ratio = -*lateral;

  const double at_peak = peak.broken_tension + peak.broken_shear;
  if (at_peak > 0)
    for (std::size_t k = 0; k <= f.peak_row && !f.crack_initiation_stress; ++k)
      if (rows[k].broken_tension + rows[k].broken_shear >= 0.01 * at_peak)
        f.crack_initiation_stress = rows[k].axial_stress_Pa;
  std::size_t densest = 0;
  for (std::size_t k = 0; k <= f.peak_row; ++k)
    if (rows[k].volumetric_strain > rows[densest].volumetric_strain) densest = k;
  if (densest < f.peak_row) f.crack_damage_stress = rows[densest].axial_stress_Pa;

  for (std::size_t k = 0; k <= f.peak_row; ++k) {
    f.platen_mismatch = std::max(f.platen_mismatch, mismatch[k] / f.peak_deviator);
    if (deviator(rows[k]) > 0.5 * f.peak_deviator && rows[k].stored_J > 0)
      f.kinetic_ratio = std::max(f.kinetic_ratio, rows[k].kinetic_J / rows[k].stored_J);
  }
  return f;
}

std::optional<MohrCoulomb> fit_mohr_coulomb(std::span<const double> confinement,
                                            std::span<const double> peak) {
  const std::size_t n = confinement.size();
  double mx = 0, my = 0;
  for (std::size_t k = 0; k < n; ++k)
    mx += confinement[k] / static_cast<double>(n), my += peak[k] / static_cast<double>(n);
  double xx = 0, xy = 0;
  for (std::size_t k = 0; k < n; ++k)
    xx += (confinement[k] - mx) * (confinement[k] - mx), xy += (confinement[k] - mx) * (peak[k] - my);
  if (n < 2 || !(xx > 0)) return {};
  const double steepness = xy / xx, unconfined = my - steepness * mx;
  if (!(steepness > 0)) return {};
  MohrCoulomb fit;
  fit.friction_angle_deg = std::asin((steepness - 1) / (steepness + 1)) * 180.0 / std::numbers::pi;
  fit.cohesion_Pa = unconfined / (2.0 * std::sqrt(steepness));
  double square = 0;
  for (std::size_t k = 0; k < n; ++k)
    square += std::pow(peak[k] - unconfined - steepness * confinement[k], 2);
  fit.residual_Pa = std::sqrt(square / static_cast<double>(n));
  fit.peaks = n;
  return fit;
}

}  // namespace breccia
