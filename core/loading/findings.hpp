// What a run and a series of runs came to. Field names are the keys of summary.json, with their
// units.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace breccia {

/// One unloading and reloading.
struct CycleSummary {
  double strain = 0;                ///< at which unloading began
  double permanent_strain = 0;      ///< where the unloading line meets zero deviator
  double unloading_modulus_Pa = 0;  ///< least-squares slope between 90 and 30 % of the deviator
  double reloading_modulus_Pa = 0;
};

/// One run. An absent optional, and a number that is not finite, is `null` in the file.
struct RunSummary {
  double confinement_Pa = 0;
  std::optional<double> confinement_measured_Pa;  ///< of it what the specimen held up, at the end of stage 1
  /// of a test with a hydrostatic stage: "elastic" or "law"; by how much the bonds' limits are
  /// raised
  std::optional<double> intermediate_stress_Pa;     ///< of a box, on the faces normal to x
  std::optional<double> cutting_force_N, thrust_N;  ///< along and across the way, means of its second half
  std::optional<double> largest_cutting_force_N;
  std::optional<double> specific_energy_J_per_m3;  ///< work of the tool over the volume that it swept
  std::string hydrostatic_branch;
  std::optional<double> limits_raised_Pa;
  std::optional<double> stage1_broken, stage1_yielded;  ///< bonds, at the end of that stage
  /// of several materials: spheres of each, and broken bonds between two of one
  std::vector<std::size_t> material_spheres, material_broken;
  std::optional<double> peak_stress_Pa;    ///< total axial
  std::optional<double> peak_deviator_Pa;  ///< total axial less confinement
  bool peak_reached = false;               ///< the stress came down again after its largest value
  std::optional<double> strain_at_peak;
  /// measured, mean over the rows within 5 % of the peak: a servo need not hold what was asked for
  std::optional<double> confining_stress_at_peak_Pa;
  std::optional<double>
      young_modulus_Pa;  ///< initial: slope of the straight part, up to 25 % of the peak deviator
  std::optional<double> young_modulus_50_Pa;  ///< tangent at half the peak deviator
  std::optional<double> poisson_ratio;
  std::optional<double> crack_initiation_stress_Pa;  ///< broken bonds reach 1 % of their number at the peak
  std::optional<double> crack_damage_stress_Pa;      ///< the volumetric strain turns
  std::optional<double> tensile_strength_Pa;         ///< bts: 2 P_max/(pi L D); tension: the peak
  std::optional<double>
      strip_corrected_strength_Pa;             ///< bts: times (1 - (b/R)^2)^(3/2), strips of half-width b
  std::optional<double> first_drop_stress_Pa;  ///< bts: the largest stress before it first fell by 5 %
  std::string first_cracks;                    ///< bts: "central", or "at the strips"
  std::optional<double> bulk_modulus_Pa;       ///< hydrostatic: slope between 5 and 25 % of the pressure
  std::vector<CycleSummary> cycles;
  std::optional<double> alpha;         ///< area factor of the bonds
  std::optional<double> alpha_affine;  ///< what an intact packing with these bonds would need; after a probe
  std::optional<double> mantle_cover;  ///< of the lateral surface by its spheres, before they are scaled
  std::uint64_t particles = 0;
  std::uint64_t loose_particles = 0;  ///< that hang on nothing between the held ends
  std::uint64_t pieces = 1;           ///< of two spheres or more, into which the bonds fall
  std::uint64_t bonds = 0;
  double coordination = 0;          ///< bonds per particle, times two
  std::uint64_t dropped_bonds = 0;  ///< in range, without an area
  std::uint64_t short_bonds = 0;
  std::uint64_t broken_tension = 0;
  std::uint64_t broken_shear = 0;
  std::optional<double> localisation;  ///< share of the volume that holds 90 % of the equivalent strain
  std::uint64_t contact_searches = 0;  ///< lists of contacts that were made
  std::optional<double> length_quantum_m, force_quantum_N;  ///< in single precision, at the end of the run
  std::uint64_t steps = 0;
  double time_step_s = 0;         ///< at the start
  double lowest_time_step_s = 0;  ///< the run's last: a step is never raised again
  std::optional<double> critical_time_step_s;
  std::uint64_t step_estimates = 0;        ///< after the first, because new contacts asked for them
  std::uint64_t local_step_estimates = 0;  ///< of what is near these contacts alone
  double mass_factor = 1;                  ///< total mass over the true one
  std::uint64_t scaled_particles = 0;
  double run_time_s = 0;  ///< wall time of the time loop
  /// wall time of each phase of the step, in its order
  std::vector<std::pair<std::string, double>> phases_s;
  std::optional<double> bond_updates_per_s;  ///< bonds x steps over run time less output and checkpoint
  std::optional<double> bond_pass_per_s;     ///< bonds x steps over phases bonds + gather
  std::optional<double> energy_error;        ///< of the work put in
  std::optional<double> kinetic_ratio;       ///< kinetic over stored, largest up to the peak
  std::optional<double> platen_mismatch;     ///< |top - bottom| over the peak, largest up to the peak
  std::optional<double> rate_error, step_error, sampling_error;  ///< of the peak: see ErrorEstimate
  std::string state_hash;                                        ///< 16 hex digits
  std::string stopped_by;             ///< "strain", "peak drop", "interrupted", ...
  std::string material_values;        ///< where the material has a table: which of its values the run used
  std::vector<std::string> warnings;  ///< one line each; empty when all is well
  /// SHA-256 of the run's files, by name: curve-K.csv, cracks-K.csv
  std::vector<std::pair<std::string, std::string>> files;
};

/// Straight line through the peaks of a series: shear strength over pressure.
struct MohrCoulomb {
  double cohesion_Pa = 0;
  double friction_angle_deg = 0;
  double residual_Pa = 0;   ///< root mean square distance of the peak stresses from the line
  std::uint64_t peaks = 0;  ///< number of runs whose peak was used
};

struct SeriesSummary {
  std::string test;     ///< "ucs", "triaxial", ...
  std::string version;  ///< of breccia
  int threads = 1;
  int ranks = 1;
  std::vector<RunSummary> runs;             ///< run K is runs[K], curve-K.csv, results.h5:/run-K
  std::optional<MohrCoulomb> mohr_coulomb;  ///< only where there were enough peaks
  std::string no_mohr_coulomb = {};         ///< why a series of a test that has such a line has none
  /// SHA-256 of all files that were read, by name
  std::vector<std::pair<std::string, std::string>> inputs{};
};

}  // namespace breccia
