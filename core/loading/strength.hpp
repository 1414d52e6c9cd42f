// Strengths and moduli as an engineer reads them off a curve.
// docs/model.md, "What is measured".
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/loading/curve_row.hpp"
#include "core/loading/findings.hpp"

namespace breccia {

/// What a curve says; absent where it does not go far enough.
struct CurveFindings {
  std::size_t peak_row = 0;
  double peak_stress = 0;    ///< Pa, total
  double peak_deviator = 0;  ///< Pa
  /// (B81): the deviator fell after its largest value: by more than 1 %, or, where that lies in the
  /// last fiftieth of the curve, 5 %. A curve that still rises falls by 1 % now and then, when a
  /// few bonds break at once. And the largest value is a strength, not a swing, and fell by more
  /// than the noise.
  bool peak_reached = false;
  std::string
      doubt;  ///< why the largest value is no strength; empty: it may be one, or the curve still rises
  double strain_at_peak = 0;
  std::optional<double> young_modulus, young_modulus_50, poisson_ratio;
  std::optional<double> crack_initiation_stress, crack_damage_stress;  ///< Pa
  /// Largest kinetic over stored, from half the peak to the peak (before, the specimen's uniform
  /// motion alone outweighs the little that is stored).
  double kinetic_ratio = 0;
  double platen_mismatch = 0;  ///< largest |top - bottom| over the peak deviator, up to the peak
};

/// Pa: a deviator below is noise. Platens that differ show waves on their way through the specimen,
/// of which three times the mean difference is counted; and where a stage of pressure came before,
/// the zero of the deviator is known to about a hundredth of the pressure.
/// @param confinement  Pa, of the stage before, or the normal stress on a shear box
/// @param mismatch     Pa, between the platens, one per row
double noise_of_deviator(double confinement, std::span<const double> mismatch);

/// Whether a deviator can be a strength. It is above the noise, and above a twentieth of the
/// confinement: the friction angle of a material that gives way there is 1.4 degrees, less than any
/// solid has.
bool can_be_strength(double deviator, double confinement, std::span<const double> mismatch);

/// @param mismatch     Pa, one per row
/// @param confinement  Pa, as in noise_of_deviator
CurveFindings read_curve(std::span<const CurveRow> rows, std::span<const double> mismatch,
                         double confinement = 0);

/// Modulus and permanent strain of each unloading (B84). @param times  s, of each: when unloaded,
/// when reloaded
std::vector<CycleSummary> read_cycles(std::span<const CurveRow> rows,
                                      std::span<const std::pair<double, double>> times);

/// The largest axial stress before it first fell by the fraction; nothing when it never did. (B85)
std::optional<double> stress_at_first_drop(std::span<const CurveRow> rows, double fraction);

/// Slope of the mean stress over the volumetric strain between 5 and 25 % of the last pressure, Pa.
/// (B86)
std::optional<double> bulk_modulus(std::span<const CurveRow> rows);

/// Straight line tau = c + sigma tan phi through the strengths of a direct shear series.
std::optional<MohrCoulomb> fit_shear_line(std::span<const double> normal_stress,
                                          std::span<const double> strength);

/// Straight line sigma_1 = q + N sigma_3 through the peaks: sin phi = (N - 1)/(N + 1), c = q/(2
/// sqrt N). (S4.37)
/// @returns nothing for fewer than two different confinements
std::optional<MohrCoulomb> fit_mohr_coulomb(std::span<const double> confinement,
                                            std::span<const double> peak);

/// Why a line through the peaks says nothing about a material: cohesion or friction angle negative.
/// Empty when it may.
std::string doubt_about(const MohrCoulomb& line);

}  // namespace breccia
