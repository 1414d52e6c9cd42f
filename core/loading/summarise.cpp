#include "core/loading/summarise.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/fields/strain.hpp"
#include "core/loading/error_estimate.hpp"
#include "core/loading/strength.hpp"
#include "core/tables/state_hash.hpp"
#include "core/world/energies.hpp"

namespace breccia {

std::string name_of(Stopped stopped) {
  switch (stopped) {
    case Stopped::strain:
      return "strain";
    case Stopped::peak_drop:
      return "peak drop";
    case Stopped::pressure:
      return "pressure";
    case Stopped::interrupted:
      return "interrupted";
    case Stopped::no_rest:
      return "no rest";
  }
  return "?";
}

namespace {

void warn_if_dynamic(const CurveFindings& f, RunSummary& run) {
  // (B87)
  if (f.kinetic_ratio > 1e-3)
    run.warnings.push_back(fmt::format(
        "dynamic: kinetic over stored energy reaches {:.1e} before the peak (quasi-static: below 1e-3); "
        "lower test.platen_speed",
        f.kinetic_ratio));
  if (f.platen_mismatch > 0.02)
    run.warnings.push_back(fmt::format(
        "dynamic: the platens differ by {:.1f} % of the peak before it (quasi-static: below 2 %); "
        "lower test.platen_speed",
        100 * f.platen_mismatch));
}

/// The pressure that was asked for and the one that acts.
void warn_of_pressure(RunSummary& run) {
  if (!run.confinement_measured_Pa) return;
  const double asked = run.confinement_Pa, held = *run.confinement_measured_Pa;
  if (std::abs(held - asked) <= 0.05 * asked) return;
  run.warnings.push_back(
      fmt::format("confinement: {:.4g} MPa were asked for, {:.4g} MPa are held by the specimen at the end of "
                  "stage 1; the lateral surface is not pressed as it should be",
                  asked * 1e-6, held * 1e-6));
}

/// alpha gives the specimen the material's modulus. Under pressure bonds may have yielded before,
/// which makes it softer; nothing makes it stiffer.
void warn_of_modulus(const Material& material, RunSummary& run) {
  if (material.own.contains("normal_stiffness")) return;  // a law with a stiffness of its own has no alpha
  const double asked = material.young_modulus;
  if (!run.young_modulus_Pa || !std::isfinite(*run.young_modulus_Pa)) return;
  const double ratio = *run.young_modulus_Pa / asked;
  if (ratio <= 1.1 && (ratio >= 0.9 || run.confinement_Pa > 0.0)) return;
  run.warnings.push_back(
      fmt::format("young_modulus: the curve has {:.4g} GPa, {:.0f} % {} than the material's {:.4g} GPa; "
                  "strengths go with it",
                  *run.young_modulus_Pa * 1e-9, 100.0 * std::abs(ratio - 1.0), ratio > 1.0 ? "more" : "less",
                  asked * 1e-9));
}

/// Moduli are those of the first loading: a way up to the peak that was unloaded is no straight
/// line.
void read_moduli_before(double unloaded, std::span<const CurveRow> rows, std::span<const double> mismatch,
                        CurveFindings& f) {
  std::size_t count = 0;
  while (count < rows.size() && rows[count].time_s < unloaded) ++count;
  const CurveFindings first = read_curve(rows.first(count), mismatch.first(count));
  f.young_modulus = first.young_modulus;
  f.poisson_ratio = first.poisson_ratio;
  f.young_modulus_50 = {};  // half the peak may lie beyond that loading
}

/// The curve of a shear box has its strength in the shear stress itself, not in what exceeds the
/// lid's pressure.
CurveFindings findings(const LaboratoryTest& test, const LoadTest& load, const LoadResult& result) {
  std::vector<CurveRow> rows = result.record.rows;
  if (test.loading == Loading::shear)
    for (CurveRow& row : rows) row.confining_stress_Pa = 0;
  CurveFindings f = read_curve(rows, result.record.mismatch, load.confinement);
  if (!result.cycles.empty())
    read_moduli_before(result.cycles.front().unloaded, rows, result.record.mismatch, f);
  if (!test.uniform_strain) f.young_modulus = f.young_modulus_50 = f.poisson_ratio = {};
  if (test.across) f.crack_damage_stress = {};  // of no volumetric strain
  return f;
}

/// Where a disc cracked first decides whether its strength is a tensile one.
/// (B85)
void read_disc(const World& w, const Assembly& a, const LoadResult& result, RunSummary& run) {
  run.tensile_strength_Pa = run.peak_stress_Pa;
  const double strip = a.strip_width / a.body.diameter;  // half-width over radius
  if (run.peak_stress_Pa)
    run.strip_corrected_strength_Pa = *run.peak_stress_Pa * std::pow(1 - strip * strip, 1.5);
  run.first_drop_stress_Pa = stress_at_first_drop(result.record.rows, 0.05);
  const auto& cracks = w.cracks.cracks;
  if (cracks.empty()) return;
  const std::size_t first = std::min<std::size_t>(20, cracks.size());
  std::size_t central = 0;
  for (std::size_t k = 0; k < first; ++k) central += std::abs(cracks[k].position.z) < 0.3 * a.body.diameter;
  run.first_cracks = 2 * central >= first ? "central" : "at the strips";
}

/// Ends that are free sideways fail first: a sphere there has neighbours on one side only, whose
/// forces push it out. (B117)
void warn_of_ends(const World& w, const Assembly& a, const LoadTest& load, RunSummary& run) {
  if (a.grip != Support::ends || load.loading != Loading::compression || w.options.rough_platens) return;
  const auto& cracks = w.cracks.cracks;
  const std::size_t first = std::min<std::size_t>(200, cracks.size());
  if (first < 20) return;
  std::size_t at_ends = 0;
  for (std::size_t k = 0; k < first; ++k) at_ends += std::abs(cracks[k].position.z) > 0.35 * a.length();
  const double share = static_cast<double>(at_ends) / static_cast<double>(first);
  if (share > 0.6)
    run.warnings.push_back(
        fmt::format("smooth platens: {:.0f} % of the first {} cracks lie at the ends: the peak is a strength "
                    "of the ends, a "
                    "fifth to a third below that of the specimen; use test.platens = \"rough\"",
                    100 * share, first));
}

/// Pa, mean over the rows around the peak whose stress is within 5 % of it: one row alone reads the
/// waves that each broken bond sends out.
double held_around_peak(std::span<const CurveRow> rows, std::size_t peak) {
  const auto is_near = [&](std::size_t k) {
    return rows[k].axial_stress_Pa > 0.95 * rows[peak].axial_stress_Pa;
  };
  std::size_t first = peak, last = peak;
  while (first > 0 && is_near(first - 1)) --first;
  while (last + 1 < rows.size() && is_near(last + 1)) ++last;
  double sum = 0;
  for (std::size_t k = first; k <= last; ++k) sum += rows[k].confining_stress_Pa;
  return sum / static_cast<double>(last - first + 1);
}

/// Spheres of each material, and what broke within it.
void read_materials(const World& w, RunSummary& run) {
  if (w.materials == 1) return;
  run.material_spheres.assign(w.materials, 0);
  run.material_broken.assign(w.materials, 0);
  const ParticleTable& p = w.particles;
  const BondTable& b = w.bonds;
  for (std::size_t row = 0; row < p.size; ++row) ++run.material_spheres[p.material[row]];
  for (std::size_t k = 0; k < b.size; ++k)
    if (const LawIndex of = p.material[b.row_lo[k]];
        of == p.material[b.row_hi[k]] && bond_state(b, k) != BondState::intact)
      ++run.material_broken[of];
}

/// What stage 1 did to the bonds.
void read_stage1(const LaboratoryTest& test, const World& w, const LoadTest& load, const LoadResult& result,
                 RunSummary& run) {
  if (test.pressure != PressureRole::lateral || load.confinement == 0.0) return;
  run.stage1_broken = static_cast<double>(result.stage1_broken);
  if (!w.features.plasticity) return;
  const bool elastic = load.hydrostatic_response == HydrostaticResponse::elastic;
  run.stage1_yielded = static_cast<double>(result.stage1_yielded);
  run.hydrostatic_branch = elastic ? "elastic" : "law";
  run.limits_raised_Pa = load.limits_raised;
  const double share = *run.stage1_yielded / static_cast<double>(w.bonds.size);
  if (elastic && share > 0.05)
    run.warnings.push_back(fmt::format(
        "{:.0f} % of the bonds yielded under {:.4g} MPa alone, though their limits were raised by "
        "{:.4g} MPa: loading does not start elastic",
        100 * share, load.confinement * 1e-6, load.limits_raised * 1e-6));
}

/// A servo that lags holds another stress than was asked for: of a shear box that dilates quickly,
/// the normal stress; of a hydrostatic test, the axial one.
void warn_if_not_held(const LaboratoryTest& test, const LoadTest& load, const LoadResult& result,
                      const CurveFindings& f, RunSummary& run) {
  const auto& rows = result.record.rows;
  if (rows.empty()) return;
  constexpr double allowed = 0.05;
  const double mega = 1e-6, asked = load.confinement;
  if (load.loading == Loading::hydrostatic) {
    double most = 0;
    for (const CurveRow& row : rows)
      if (row.confining_stress_Pa > 0.25 * asked)
        most = std::max(most, std::abs(row.axial_stress_Pa / row.confining_stress_Pa - 1.0));
    if (most > allowed)
      run.warnings.push_back(
          fmt::format("the axial stress differs by {:.0f} % from the pressure on the lateral surface; lower "
                      "test.platen_speed",
                      100 * most));
    return;
  }
  if (asked == 0 || test.rigid_sides) return;
  const double held = held_around_peak(rows, f.peak_row);
  run.confining_stress_at_peak_Pa = held;
  double square = 0;  // on the way up
  for (std::size_t k = 0; k <= f.peak_row; ++k)
    square += std::pow(rows[k].confining_stress_Pa / asked - 1.0, 2) / static_cast<double>(f.peak_row + 1);
  const double off = std::sqrt(square),
               at_peak = std::abs(rows[f.peak_row].confining_stress_Pa / asked - 1.0);
  if (std::max({off, at_peak, std::abs(held / asked - 1.0)}) > allowed)
    run.warnings.push_back(fmt::format(
        "{} was {:.4g} MPa around the peak ({:.0f} % off at it, {:.0f} % on the way to it), where "
        "{:.4g} MPa was asked for; lower test.platen_speed",
        load.loading == Loading::shear ? "the normal stress" : "the confinement", mega * held, 100 * at_peak,
        100 * off, mega * asked));
}

/// Elastic constants that no solid has are those of a specimen that yields: under its confinement,
/// or at once.
void warn_if_not_elastic(const CurveFindings& f, RunSummary& run) {
  constexpr double noise = 0.05;
  if (f.poisson_ratio && !(*f.poisson_ratio > -noise && *f.poisson_ratio < 0.5 + noise))
    run.warnings.push_back(fmt::format(
        "poisson_ratio {:.2f} is none of a solid: the specimen was not elastic where the moduli are read",
        *f.poisson_ratio));
  if (f.young_modulus && !(*f.young_modulus > 0.0))
    run.warnings.push_back(
        fmt::format("young_modulus {:.3g} GPa is none of a solid", *f.young_modulus * 1e-9));
}

/// An unloading that a case asks for, and that its run ended before.
void warn_if_not_unloaded(const LoadTest& load, const LoadResult& result, RunSummary& run) {
  for (std::size_t k = result.cycles.size(); k < load.unload_at.size(); ++k)
    run.warnings.push_back(fmt::format("test.unload_at {:g} was not reached: the run had ended ({})",
                                       load.unload_at[k], run.stopped_by));
  if (!result.cycles.empty() && !(result.cycles.back().reloaded > result.cycles.back().unloaded))
    run.warnings.push_back(fmt::format("test.unload_at {:g}: the run ended ({}) before it was loaded again",
                                       load.unload_at[result.cycles.size() - 1], run.stopped_by));
}

/// Under even pressure there is no peak; the answer is a bulk modulus.
void forget_the_peak(const LoadResult& result, RunSummary& run) {
  run.peak_reached = false;
  run.peak_deviator_Pa = run.strain_at_peak = run.young_modulus_Pa = run.young_modulus_50_Pa =
      run.poisson_ratio = run.crack_damage_stress_Pa = run.kinetic_ratio = run.platen_mismatch = {};
  run.peak_stress_Pa = 0;
  for (const CurveRow& row : result.record.rows)
    run.peak_stress_Pa = std::max(*run.peak_stress_Pa, row.axial_stress_Pa);
  run.bulk_modulus_Pa = bulk_modulus(result.record.rows);
}

/// A cut has no strength; the answer is the forces on the tool and what a volume costs.
void read_cut(const World& w, const LoadResult& result, RunSummary& run) {
  run.peak_reached = false;
  run.peak_stress_Pa = run.peak_deviator_Pa = run.strain_at_peak = run.kinetic_ratio =
      run.platen_mismatch = {};
  run.crack_initiation_stress_Pa = run.crack_damage_stress_Pa = {};
  const auto& rows = result.record.rows;
  if (rows.empty()) return;
  const double way = rows.back().platen_strain;
  double along = 0, across = 0, count = 0, largest = 0, energy = 0, before = 0;
  for (const CurveRow& row : rows) {
    largest = std::max(largest, row.axial_stress_Pa);
    energy += row.axial_stress_Pa * (row.platen_strain - before);
    before = row.platen_strain;
    if (row.platen_strain < 0.5 * way) continue;
    along += row.axial_stress_Pa, across += row.confining_stress_Pa, ++count;
  }
  run.cutting_force_N = w.tool.area * along / count;
  run.thrust_N = w.tool.area * across / count;
  run.largest_cutting_force_N = w.tool.area * largest;
  run.specific_energy_J_per_m3 = energy / way;  // (B120)
}

}  // namespace

RunSummary summarise(const LaboratoryTest& test, const World& w, const Assembly& a, const LoadTest& load,
                     const LoadResult& result) {
  const CurveFindings f = findings(test, load, result);
  RunSummary run;
  run.confinement_Pa = load.confinement;
  if (load.intermediate > 0.0) run.intermediate_stress_Pa = load.intermediate;
  if (!result.record.rows.empty()) {
    run.peak_stress_Pa = f.peak_stress;
    run.peak_deviator_Pa = f.peak_deviator;
    run.strain_at_peak = f.strain_at_peak;
    run.kinetic_ratio = f.kinetic_ratio;
    run.platen_mismatch = f.platen_mismatch;
  }
  run.peak_reached = f.peak_reached;
  run.young_modulus_Pa = f.young_modulus;
  run.young_modulus_50_Pa = f.young_modulus_50;
  run.poisson_ratio = f.poisson_ratio;
  run.crack_initiation_stress_Pa = f.crack_initiation_stress;
  run.crack_damage_stress_Pa = f.crack_damage_stress;
  run.alpha = w.alpha;
  if (std::isfinite(result.held_pressure)) run.confinement_measured_Pa = result.held_pressure;
  run.particles = w.particles.size;
  run.bonds = w.bonds.size;
  run.coordination = a.coordination;
  run.dropped_bonds = a.dropped_bonds;
  run.short_bonds = a.short_bonds;
  const BrokenCount broken = count_broken(w);
  run.broken_tension = broken.tension;
  run.broken_shear = broken.shear;
  run.localisation = localisation(w);
  run.contact_searches = w.neighbour_list.rebuilds;
  if (w.options.precision == Precision::single) {
    run.length_quantum_m = w.single.quanta.length;
    run.force_quantum_N = w.single.quanta.force;
  }
  run.steps = w.step;
  run.time_step_s = w.step_monitor.first_dt;
  run.lowest_time_step_s = w.dt;
  run.critical_time_step_s = w.critical_dt;
  run.step_estimates = w.step_monitor.looks;
  run.local_step_estimates = w.step_monitor.local_looks;
  run.mass_factor = w.mass_scaling.factor;
  run.scaled_particles = w.mass_scaling.scaled;
  run.run_time_s = result.run_time;
  for (std::size_t k = 0; k < phase_names.size(); ++k)
    run.phases_s.emplace_back(phase_names[k], w.phases.seconds[k]);
  const double updates = static_cast<double>(w.bonds.size) * static_cast<double>(w.step);
  run.bond_updates_per_s =
      updates / (result.run_time - w.phases[Phase::output] - w.phases[Phase::checkpoint]);
  run.bond_pass_per_s = updates / (w.phases[Phase::bonds] + w.phases[Phase::gather]);
  if (w.ledger.enabled) run.energy_error = energy_error(w.ledger);
  run.state_hash = state_hash(w.particles, w.bonds);
  run.stopped_by = name_of(result.stopped);
  run.warnings = result.warnings;
  warn_of_pressure(run);
  read_stage1(test, w, load, result, run);
  read_materials(w, run);
  warn_if_not_held(test, load, result, f, run);
  warn_if_not_unloaded(load, result, run);
  if (test.across) read_disc(w, a, result, run);
  if (test.tensile) run.tensile_strength_Pa = run.peak_stress_Pa;
  if (test.loading == Loading::shear) run.peak_deviator_Pa.reset();
  std::vector<std::pair<double, double>> cycles;
  for (const Cycle& c : result.cycles) cycles.emplace_back(c.unloaded, c.reloaded);
  run.cycles = read_cycles(result.record.rows, cycles);
  if (w.cracks.missed > 0)
    run.warnings.push_back(
        fmt::format("{} bonds broke in steps that broke too many at once to record each", w.cracks.missed));
  if (load.loading == Loading::cutting) {
    read_cut(w, result, run);
    return run;
  }
  if (load.loading == Loading::hydrostatic) {
    forget_the_peak(result, run);
    return run;
  }
  if (!f.doubt.empty()) {
    run.warnings.push_back("no strength: " + f.doubt);
    run.tensile_strength_Pa = run.strip_corrected_strength_Pa = {};
  }
  warn_of_ends(w, a, load, run);
  warn_if_not_elastic(f, run);
  warn_if_dynamic(f, run);
  if (w.materials == 1) warn_of_modulus(w.material, run);
  if (run.peak_reached) {
    const ErrorEstimate e =
        estimate_error(f.kinetic_ratio, f.platen_mismatch, run.energy_error, run.particles);
    run.rate_error = e.rate;
    run.step_error = e.step;
    run.sampling_error = e.sampling;
  }
  return run;
}

void fit_peaks(const LaboratoryTest& test, SeriesSummary& series) {
  series.mohr_coulomb.reset();
  series.no_mohr_coulomb.clear();
  if (series.runs.size() < 2 || test.line == StrengthLine::none) return;
  std::vector<double> confinement, peak;
  for (const RunSummary& run : series.runs) {
    if (!run.peak_reached) continue;  // the largest stress so far is not a strength
    confinement.push_back(run.confining_stress_at_peak_Pa.value_or(run.confinement_Pa));
    peak.push_back(*run.peak_stress_Pa);
  }
  const auto line = test.line == StrengthLine::shear ? fit_shear_line(confinement, peak)
                                                     : fit_mohr_coulomb(confinement, peak);
  if (line)
    series.no_mohr_coulomb = doubt_about(*line);
  else
    series.no_mohr_coulomb = peak.size() < 2
                                 ? fmt::format("{} of {} runs reached a peak, and a line needs two",
                                               peak.size(), series.runs.size())
                                 : "the peaks do not rise with the confinement";
  if (line && series.no_mohr_coulomb.empty()) series.mohr_coulomb = line;
}

}  // namespace breccia
