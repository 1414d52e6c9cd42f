// What is read off a curve, on curves that are known.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "core/strength.hpp"

using namespace breccia;

namespace {

constexpr double confinement = 4e6;

/// Deviator: 30 GPa to 20 MPa, then 15 GPa to 40 MPa at strain 0.002, then down. Radial -0.2, then -0.5 of the axial.
double deviator_at(double e) {
  const double knee = 20e6 / 30e9, top = knee + 20e6 / 15e9;
  if (e < knee) return 30e9 * e;
  return e < top ? 20e6 + 15e9 * (e - knee) : 40e6 - 10e9 * (e - top);
}

std::vector<CurveRow> curve(double last, int rows = 1000) {
  std::vector<CurveRow> all;
  for (int k = 0; k <= rows; ++k) {
    CurveRow r;
    r.axial_strain = last * k / rows;
    r.axial_stress_Pa = confinement + deviator_at(r.axial_strain);
    r.confining_stress_Pa = confinement;
    r.radial_strain = r.axial_strain < 0.001 ? -0.2 * r.axial_strain : -0.2e-3 - 0.8 * (r.axial_strain - 0.001);
    r.volumetric_strain = r.axial_strain + 2 * r.radial_strain;
    r.broken_tension = r.axial_strain > 0.0008 ? std::floor(1e5 * (r.axial_strain - 0.0008)) : 0;
    r.broken_shear = 0;
    r.stored_J = 10;
    r.kinetic_J = r.axial_strain < 0.0004 ? 5 : 1e-3 * r.axial_strain / 0.002;
    all.push_back(r);
  }
  return all;
}

std::vector<double> mismatch(const std::vector<CurveRow>& rows) {
  std::vector<double> m;
  for (const CurveRow& r : rows) m.push_back(r.axial_strain < 0.0021 ? 1e5 : 9e9);
  return m;
}

}  // namespace

TEST_CASE("strength: peak, moduli, Poisson's ratio of a curve of two slopes [DESIGN summary.json, rel 1e-9]") {
  const auto rows = curve(0.003);
  const auto f = read_curve(rows, mismatch(rows));
  CHECK(f.peak_deviator == doctest::Approx(40e6).epsilon(1e-3));  // rows are 3e-6 of strain apart
  CHECK(f.peak_stress == doctest::Approx(f.peak_deviator + confinement).epsilon(1e-12));
  CHECK(f.strain_at_peak == doctest::Approx(0.002).epsilon(1e-3));
  CHECK(f.peak_reached);
  CHECK(f.young_modulus.value() == doctest::Approx(30e9).epsilon(1e-9));
  CHECK(f.poisson_ratio.value() == doctest::Approx(0.2).epsilon(1e-9));
  // half the peak is where the slopes meet: between the two
  CHECK(f.young_modulus_50.value() > 15e9);
  CHECK(f.young_modulus_50.value() < 30e9);
  // 120 broken at the peak: 1 % of it are 2 bonds, at strain 0.00082
  CHECK(f.crack_initiation_stress.value() == doctest::Approx(confinement + deviator_at(0.00082)).epsilon(2e-3));
  // the volume turns where the radial strain becomes steeper than half the axial
  CHECK(f.crack_damage_stress.value() == doctest::Approx(confinement + deviator_at(0.001)).epsilon(2e-3));
  CHECK(f.kinetic_ratio == doctest::Approx(1e-4).epsilon(2e-3));  // not the 0.5 before half the peak
  CHECK(f.platen_mismatch == doctest::Approx(1e5 / 40e6).epsilon(1e-3));
}

TEST_CASE("strength: a curve that has not come down has no peak reached, one that fell by 1 % has [exact]") {
  for (const auto& [last, reached] : {std::pair{0.0015, false}, {0.00202, false}, {0.00206, true}}) {
    const auto rows = curve(last);
    CHECK(read_curve(rows, std::vector<double>(rows.size(), 0.0)).peak_reached == reached);
  }
  CHECK(read_curve({}, {}).peak_deviator == 0);
  const auto rows = curve(0.0006);
  const auto f = read_curve(rows, std::vector<double>(rows.size(), 0.0));
  CHECK(!f.crack_initiation_stress);
  CHECK(!f.crack_damage_stress);
  CHECK(f.young_modulus.value() == doctest::Approx(30e9).epsilon(1e-9));
  CHECK(f.young_modulus_50.value() == doctest::Approx(30e9).epsilon(1e-9));
}

TEST_CASE("strength: a rising part that dips uses the last way up to the peak [exact]") {
  auto rows = curve(0.003);
  for (int k = 0; k < 200; ++k) {  // a first loop, unloaded: slope 10 GPa, to 6 MPa
    CurveRow r = rows[0];
    r.axial_strain = -0.0006 + 3e-6 * k;
    r.axial_stress_Pa = confinement + 10e9 * (0.0003 - std::abs(r.axial_strain + 0.0003));
    rows.insert(rows.begin() + k, r);
  }
  const auto f = read_curve(rows, std::vector<double>(rows.size(), 0.0));
  CHECK(f.young_modulus.value() == doctest::Approx(30e9).epsilon(1e-9));
}

TEST_CASE("strength: Mohr-Coulomb through peaks that lie on a line, and off it [sigma_1 = q + N sigma_3, rel 1e-12]") {
  const double phi = 35 * std::numbers::pi / 180, c = 8e6;
  const double N = (1 + std::sin(phi)) / (1 - std::sin(phi)), q = 2 * c * std::cos(phi) / (1 - std::sin(phi));
  const std::vector<double> p{0, 4.5e6, 9e6, 30e6};
  std::vector<double> peak;
  for (const double s : p) peak.push_back(q + N * s);
  const auto fit = fit_mohr_coulomb(p, peak).value();
  CHECK(fit.friction_angle_deg == doctest::Approx(35).epsilon(1e-12));
  CHECK(fit.cohesion_Pa == doctest::Approx(8e6).epsilon(1e-12));
  CHECK(fit.residual_Pa < 1e-6);
  CHECK(fit.peaks == 4);

  const std::vector<double> square{0, 0, 2e6, 2e6}, off{10e6, 12e6, 20e6, 22e6};  // line 11 + 5 p, all 1 MPa off
  const auto rough = fit_mohr_coulomb(square, off).value();
  CHECK(rough.residual_Pa == doctest::Approx(1e6).epsilon(1e-12));
  CHECK(rough.cohesion_Pa == doctest::Approx(11e6 / (2 * std::sqrt(5.0))).epsilon(1e-12));
  const std::vector<double> one{1e6}, same{1e6, 1e6}, two{20e6, 30e6};
  CHECK(!fit_mohr_coulomb(one, one));
  CHECK(!fit_mohr_coulomb(same, two));
  CHECK(!fit_mohr_coulomb({}, {}));
}
