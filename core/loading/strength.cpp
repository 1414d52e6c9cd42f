#include "core/loading/strength.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

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

/// The straight part of the curve from which moduli are read: between 5 and 25 % of the peak
/// deviator, or, where that part is bent, between the same fractions of less: under a large
/// pressure bonds yield long before a quarter of the peak. (B82)
std::span<const CurveRow> straight_part(std::span<const CurveRow> rows, std::size_t peak) {
  constexpr double bent = 0.98;       // slope of the upper half over that of the lower
  constexpr std::size_t fewest = 12;  // rows
  const auto strain = [](const CurveRow& r) { return r.axial_strain; };
  std::span<const CurveRow> part = rising(rows, peak, 0.05, 0.25);
  for (double high = 0.25; high > 0.02; high *= 0.8) {
    const auto shorter = rising(rows, peak, 0.2 * high, high);
    if (shorter.size() < fewest) break;
    part = shorter;
    const auto lower = slope(rising(rows, peak, 0.2 * high, 0.6 * high), strain, deviator),
               upper = slope(rising(rows, peak, 0.6 * high, high), strain, deviator);
    if (!lower || !upper || !(*upper < bent * *lower)) break;
  }
  return part;
}

/// Why a largest deviator that the curve has come down from, or never rose to, is no strength.
std::string doubt_about_peak(const CurveFindings& f, double confinement, std::span<const double> mismatch) {
  constexpr double mega = 1e-6;
  if (!std::isfinite(f.peak_deviator)) return "the stress is not a number";
  if (!(f.peak_deviator > 0.0))
    return fmt::format("the deviator never rises above zero: at most {:.3g} MPa", mega * f.peak_deviator);
  const double noise = noise_of_deviator(confinement, mismatch.first(f.peak_row + 1));
  if (!(f.peak_deviator > noise))
    return fmt::format("the largest deviator, {:.3g} MPa, is within the noise, {:.3g} MPa",
                       mega * f.peak_deviator, mega * noise);
  if (!can_be_strength(f.peak_deviator, confinement, mismatch.first(f.peak_row + 1)))
    return fmt::format("the largest deviator, {:.3g} MPa, is less than a twentieth of the confinement",
                       mega * f.peak_deviator);
  if (f.peak_row < 2) return "the largest stress stands in the first rows of the curve";
  return {};
}

}  // namespace

// (B102)
double noise_of_deviator(double confinement, std::span<const double> mismatch) {
  double noise = 0.01 * confinement;
  if (!mismatch.empty())
    noise = std::max(noise, 3.0 * std::accumulate(mismatch.begin(), mismatch.end(), 0.0) /
                                static_cast<double>(mismatch.size()));
  return noise;
}

bool can_be_strength(double deviator, double confinement, std::span<const double> mismatch) {
  return deviator > 0.05 * confinement && deviator > noise_of_deviator(confinement, mismatch);
}

CurveFindings read_curve(std::span<const CurveRow> rows, std::span<const double> mismatch,
                         double confinement) {
  CurveFindings f;
  if (rows.empty()) return f;
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (deviator(rows[k]) > deviator(rows[f.peak_row])) f.peak_row = k;
  const CurveRow& peak = rows[f.peak_row];
  f.peak_stress = peak.axial_stress_Pa;
  f.peak_deviator = deviator(peak);
  f.strain_at_peak = peak.axial_strain;
  double lowest = f.peak_deviator;  // since the peak
  for (std::size_t k = f.peak_row; k < rows.size(); ++k) lowest = std::min(lowest, deviator(rows[k]));
  const bool lasts = 50 * (rows.size() - 1 - f.peak_row) >= rows.size();
  const auto before = mismatch.first(f.peak_row + 1);
  const double fallen = f.peak_deviator - lowest, noise = noise_of_deviator(confinement, before);
  f.peak_reached = lowest < (lasts ? 0.99 : 0.95) * f.peak_deviator && 3.0 * fallen > noise;  // (B81)
  f.doubt = doubt_about_peak(f, confinement, mismatch);
  // a curve that still rises at its end, from next to nothing, has merely been cut off
  const bool rises = f.peak_row + 1 == rows.size() && f.peak_deviator > 0.0;
  if (rises && !f.peak_reached) f.doubt.clear();
  if (!f.doubt.empty()) f.peak_reached = false;
  if (!(f.peak_deviator > noise)) return f;  // nor do moduli follow from noise

  const auto strain = [](const CurveRow& r) { return r.axial_strain; };
  const auto initial = straight_part(rows, f.peak_row);
  f.young_modulus = slope(initial, strain, deviator);
  f.young_modulus_50 = slope(rising(rows, f.peak_row, 0.45, 0.55), strain, deviator);
  if (const auto lateral = slope(initial, strain, [](const CurveRow& r) { return r.radial_strain; }))
    f.poisson_ratio = -*lateral;

  const double at_peak = peak.broken_tension + peak.broken_shear;
  if (at_peak > 0)
    for (std::size_t k = 0; k <= f.peak_row && !f.crack_initiation_stress; ++k)
      // (B83)
      if (rows[k].broken_tension + rows[k].broken_shear >= 0.01 * at_peak)
        f.crack_initiation_stress = rows[k].axial_stress_Pa;
  std::size_t densest = 0;
  for (std::size_t k = 0; k <= f.peak_row; ++k)
    if (rows[k].volumetric_strain > rows[densest].volumetric_strain) densest = k;
  if (densest < f.peak_row) f.crack_damage_stress = rows[densest].axial_stress_Pa;  // (B83)

  for (std::size_t k = 0; k <= f.peak_row; ++k) {
    f.platen_mismatch = std::max(f.platen_mismatch, mismatch[k] / f.peak_deviator);
    // (B87)
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
  fit.cohesion_Pa = unconfined / (2.0 * std::sqrt(steepness));  // (S4.37)
  double square = 0;
  for (std::size_t k = 0; k < n; ++k)
    square += std::pow(peak[k] - unconfined - steepness * confinement[k], 2);
  fit.residual_Pa = std::sqrt(square / static_cast<double>(n));
  fit.peaks = n;
  return fit;
}

std::vector<CycleSummary> read_cycles(std::span<const CurveRow> rows,
                                      std::span<const std::pair<double, double>> times) {
  std::vector<CycleSummary> cycles;
  const auto strain = [](const CurveRow& r) { return r.axial_strain; };
  for (const auto& [unloaded, reloaded] : times) {
    const auto at = [&](double time) {
      std::size_t k = 0;
      while (k + 1 < rows.size() && rows[k].time_s < time) ++k;
      return k;
    };
    if (!(reloaded > unloaded)) continue;  // the run ended while it was unloading
    const std::size_t top = at(unloaded), bottom = at(reloaded);
    const double load = deviator(rows[top]);
    std::size_t end = bottom;
    while (end + 1 < rows.size() && deviator(rows[end]) < load &&
           rows[end].axial_strain < rows[top].axial_strain)
      ++end;
    const auto between = [&](std::size_t first, std::size_t last) {
      std::vector<CurveRow> part;
      for (std::size_t k = first; k <= last; ++k)
        if (deviator(rows[k]) < 0.9 * load && deviator(rows[k]) > 0.3 * load) part.push_back(rows[k]);
      return part;
    };
    const std::vector<CurveRow> down = between(top, bottom), up = between(bottom, end);
    const auto unloading = slope(std::span<const CurveRow>(down), strain, deviator);
    const auto reloading = slope(std::span<const CurveRow>(up), strain, deviator);
    if (!unloading || !reloading) continue;
    double mean_strain = 0, mean_deviator = 0;
    for (const CurveRow& r : down) mean_strain += r.axial_strain, mean_deviator += deviator(r);
    const double one = 1.0 / static_cast<double>(down.size());
    cycles.push_back(
        {rows[top].axial_strain, one * (mean_strain - mean_deviator / *unloading), *unloading, *reloading});
  }
  return cycles;
}

std::optional<double> stress_at_first_drop(std::span<const CurveRow> rows, double fraction) {
  double most = 0;
  for (const CurveRow& r : rows) {
    if (r.axial_stress_Pa < (1.0 - fraction) * most && most > 0) return most;
    most = std::max(most, r.axial_stress_Pa);
  }
  return {};
}

std::optional<double> bulk_modulus(std::span<const CurveRow> rows) {
  if (rows.empty()) return {};
  std::vector<CurveRow> part;
  const double last = rows.back().confining_stress_Pa;
  for (const CurveRow& r : rows)
    if (r.confining_stress_Pa > 0.05 * last && r.confining_stress_Pa < 0.25 * last) part.push_back(r);
  return slope(
      std::span<const CurveRow>(part), [](const CurveRow& r) { return r.volumetric_strain; },
      [](const CurveRow& r) { return (r.axial_stress_Pa + 2.0 * r.confining_stress_Pa) / 3.0; });
}

std::optional<MohrCoulomb> fit_shear_line(std::span<const double> normal_stress,
                                          std::span<const double> strength) {
  const std::size_t n = normal_stress.size();
  double mx = 0, my = 0, xx = 0, xy = 0;
  for (std::size_t k = 0; k < n; ++k) mx += normal_stress[k] / double(n), my += strength[k] / double(n);
  for (std::size_t k = 0; k < n; ++k) {
    xx += (normal_stress[k] - mx) * (normal_stress[k] - mx);
    xy += (normal_stress[k] - mx) * (strength[k] - my);
  }
  if (n < 2 || !(xx > 0)) return {};
  MohrCoulomb line;
  line.friction_angle_deg = std::atan(xy / xx) * 180.0 / std::numbers::pi;
  line.cohesion_Pa = my - xy / xx * mx;
  double square = 0;
  for (std::size_t k = 0; k < n; ++k)
    square += std::pow(strength[k] - line.cohesion_Pa - xy / xx * normal_stress[k], 2);
  line.residual_Pa = std::sqrt(square / double(n));
  line.peaks = n;
  return line;
}

std::string doubt_about(const MohrCoulomb& line) {
  if (!std::isfinite(line.cohesion_Pa) || !std::isfinite(line.friction_angle_deg))
    return "the line through the peaks is not a number";
  const double c = line.cohesion_Pa * 1e-6, phi = line.friction_angle_deg;
  if (c < 0.0 || phi < 0.0)
    return fmt::format(
        "the line through {} peaks has {} ({:.2f} MPa, {:.1f} deg), which no material has", line.peaks,
        c < 0.0 ? phi < 0.0 ? "cohesion and friction angle below zero" : "a cohesion below zero"
                : "a friction angle below zero",
        c, phi);
  return {};
}

}  // namespace breccia
