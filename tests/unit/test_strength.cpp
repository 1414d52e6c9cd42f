// What is read off a curve, on curves that are known.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "core/loading/strength.hpp"

using namespace breccia;

namespace {

constexpr double confinement = 4e6;

/// Deviator: 30 GPa to 20 MPa, then 15 GPa to 40 MPa at strain 0.002, then down. Radial -0.2, then
/// -0.5 of the axial.
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
    r.radial_strain =
        r.axial_strain < 0.001 ? -0.2 * r.axial_strain : -0.2e-3 - 0.8 * (r.axial_strain - 0.001);
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

TEST_CASE("strength: peak, moduli, Poisson's ratio of a curve of two slopes [(B82), rel 1e-9]") {
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
  CHECK(f.crack_initiation_stress.value() ==
        doctest::Approx(confinement + deviator_at(0.00082)).epsilon(2e-3));
  // the volume turns where the radial strain becomes steeper than half the axial
  CHECK(f.crack_damage_stress.value() == doctest::Approx(confinement + deviator_at(0.001)).epsilon(2e-3));
  CHECK(f.kinetic_ratio == doctest::Approx(1e-4).epsilon(2e-3));  // not the 0.5 before half the peak
  CHECK(f.platen_mismatch == doctest::Approx(1e5 / 40e6).epsilon(1e-3));
}

TEST_CASE(
    "strength: a curve that rises to its end in saws of 1.5 % has no peak, with a fall of 6 % there it has "
    "[exact]") {
  std::vector<CurveRow> rows;
  for (int k = 0; k < 500; ++k) {
    CurveRow row;
    row.time_s = row.axial_strain = 1e-5 * k;
    row.axial_stress_Pa = 30e6 + 2e4 * k - 6e5 * (k % 5) / 4.0;
    rows.push_back(row);
  }
  REQUIRE(rows.back().axial_stress_Pa < 0.99 * rows[495].axial_stress_Pa);
  const std::vector<double> none(rows.size(), 0.0);
  CHECK_FALSE(read_curve(rows, none).peak_reached);
  rows.back().axial_stress_Pa *= 0.95;
  CHECK(read_curve(rows, none).peak_reached);
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

TEST_CASE("strength: a swing below the noise or a twentieth of the confinement is no peak [exact]") {
  std::vector<CurveRow> rows;
  for (int k = 0; k < 500; ++k) {  // a deviator of 2 MPa at most, gone again in the end
    CurveRow row;
    row.time_s = row.axial_strain = 1e-6 * k;
    row.confining_stress_Pa = 30e6;
    row.axial_stress_Pa = 30e6 + 2e6 * std::sin(std::numbers::pi * k / 499.0);
    rows.push_back(row);
  }
  const auto read = [&](double pressure, double differ) {
    return read_curve(rows, std::vector<double>(rows.size(), differ), pressure);
  };
  CHECK(read(30e6, 0).peak_reached);  // 1.5 MPa would be a twentieth
  CHECK(read(30e6, 0).doubt.empty());
  CHECK_FALSE(read(50e6, 0).peak_reached);
  CHECK(read(50e6, 0).doubt.find("a twentieth of the confinement") != std::string::npos);
  CHECK(read(50e6, 0).young_modulus);
  CHECK_FALSE(read(0, 0.7e6).peak_reached);  // three times what the platens differ by
  CHECK(read(0, 0.7e6).doubt.find("within the noise") != std::string::npos);
  CHECK_FALSE(read(0, 0.7e6).young_modulus);
  CHECK(read(0, 0.6e6).peak_reached);
  for (CurveRow& row : rows) row.axial_stress_Pa -= 3e6;
  CHECK_FALSE(read(30e6, 0).peak_reached);
  CHECK(read(30e6, 0).doubt.find("never rises above zero") != std::string::npos);
  rows.front().axial_stress_Pa = 60e6;
  CHECK(read(30e6, 0).doubt.find("in the first rows") != std::string::npos);
  rows.front().axial_stress_Pa = std::nan("");
  CHECK(read(30e6, 0).doubt.find("not a number") != std::string::npos);
}

TEST_CASE("strength: a line through peaks with negative cohesion or friction angle is none [exact]") {
  const std::vector<double> p{1e6, 2e6};
  CHECK(doubt_about(*fit_mohr_coulomb(p, std::vector{20e6, 24e6})).empty());
  CHECK(doubt_about(*fit_mohr_coulomb(p, std::vector{4e6, 9e6})).find("a cohesion below zero") !=
        std::string::npos);
  CHECK(doubt_about(*fit_mohr_coulomb(p, std::vector{20e6, 20.5e6})).find("a friction angle below zero") !=
        std::string::npos);
  CHECK(doubt_about(*fit_shear_line(p, std::vector{0.5e6, 2e6})).find("a cohesion below zero") !=
        std::string::npos);
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

TEST_CASE(
    "strength: Mohr-Coulomb through peaks that lie on a line, and off it [sigma_1 = q + N sigma_3, rel "
    "1e-12]") {
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

  const std::vector<double> square{0, 0, 2e6, 2e6},
      off{10e6, 12e6, 20e6, 22e6};  // line 11 + 5 p, all 1 MPa off
  const auto rough = fit_mohr_coulomb(square, off).value();
  CHECK(rough.residual_Pa == doctest::Approx(1e6).epsilon(1e-12));
  CHECK(rough.cohesion_Pa == doctest::Approx(11e6 / (2 * std::sqrt(5.0))).epsilon(1e-12));
  const std::vector<double> one{1e6}, same{1e6, 1e6}, two{20e6, 30e6};
  CHECK(!fit_mohr_coulomb(one, one));
  CHECK(!fit_mohr_coulomb(same, two));
  CHECK(!fit_mohr_coulomb({}, {}));
}

namespace {

/// Straight pieces from corner to corner of (axial strain, deviator), 100 rows each, one a
/// millisecond.
std::vector<CurveRow> through(const std::vector<std::pair<double, double>>& corners) {
  std::vector<CurveRow> rows{CurveRow{}};
  double e = 0, q = 0;
  for (const auto& [to_e, to_q] : corners) {
    for (int k = 1; k <= 100; ++k) {
      CurveRow r;
      r.axial_strain = e + (to_e - e) * k / 100;
      r.confining_stress_Pa = confinement;
      r.axial_stress_Pa = confinement + q + (to_q - q) * k / 100;
      r.time_s = 1e-3 * double(rows.size());
      rows.push_back(r);
    }
    e = to_e, q = to_q;
  }
  return rows;
}

}  // namespace

TEST_CASE(
    "strength: moduli of a curve that bends at a tenth of its peak are those below the bend [(B82), rel "
    "1e-9]") {
  // 30 GPa and -0.2 to 4 MPa, then 10 GPa and -0.4 to 40 MPa: a quarter of the peak is 10 MPa
  std::vector<CurveRow> rows;
  const double knee = 4e6 / 30e9, top = knee + 36e6 / 10e9;
  for (int k = 0; k <= 2000; ++k) {
    CurveRow r;
    const double e = r.axial_strain = 1.2 * top * k / 2000;
    r.axial_stress_Pa = e < knee ? 30e9 * e : e < top ? 4e6 + 10e9 * (e - knee) : 40e6 - 10e9 * (e - top);
    r.radial_strain = e < knee ? -0.2 * e : -0.2 * knee - 0.4 * (e - knee);
    r.stored_J = 10;
    rows.push_back(r);
  }
  const auto f = read_curve(rows, std::vector<double>(rows.size(), 0.0));
  CHECK(f.young_modulus.value() == doctest::Approx(30e9).epsilon(1e-9));
  CHECK(f.poisson_ratio.value() == doctest::Approx(0.2).epsilon(1e-9));
}

TEST_CASE("strength: cycles: moduli down and up and the strain that stays - of straight pieces [rel 1e-9]") {
  // up to 40 MPa at 0.002; down at 25 GPa to 4 MPa; up at 24 GPa to 40 MPa; on to 44 MPa at 0.003;
  // again
  const double down = 0.002 - 36e6 / 25e9, up = down + 36e6 / 24e9, down2 = 0.003 - 39.6e6 / 20e9;
  const auto rows =
      through({{0.002, 40e6}, {down, 4e6}, {up, 40e6}, {0.003, 44e6}, {down2, 4.4e6}, {0.0035, 45e6}});
  const std::vector<std::pair<double, double>> times{{0.1, 0.2}, {0.4, 0.5}};
  const auto cycles = read_cycles(rows, times);
  REQUIRE(cycles.size() == 2);
  CHECK(cycles[0].strain == doctest::Approx(0.002).epsilon(1e-12));
  CHECK(cycles[0].unloading_modulus_Pa == doctest::Approx(25e9).epsilon(1e-9));
  CHECK(cycles[0].reloading_modulus_Pa == doctest::Approx(24e9).epsilon(1e-9));
  CHECK(cycles[0].permanent_strain == doctest::Approx(0.002 - 40e6 / 25e9).epsilon(1e-9));
  CHECK(cycles[1].strain == doctest::Approx(0.003).epsilon(1e-12));
  CHECK(cycles[1].unloading_modulus_Pa == doctest::Approx(20e9).epsilon(1e-9));
  CHECK(cycles[1].permanent_strain == doctest::Approx(0.003 - 44e6 / 20e9).epsilon(1e-9));
  CHECK(cycles[1].reloading_modulus_Pa == doctest::Approx(40.6e6 / (0.0035 - down2)).epsilon(1e-9));
  // a run that ended while it was unloading has no cycle more
  const std::vector<std::pair<double, double>> open{{0.1, 0.2}, {0.4, 0.0}};
  CHECK(read_cycles(rows, open).size() == 1);
  CHECK(read_cycles(rows, {}).empty());
}

TEST_CASE("strength: the first drop of 5 % is not the small one before nor the larger peak behind [exact]") {
  // 10 MPa, down 4 %, 12 MPa, down 8 %, 20 MPa, down 50 %: of the deviator plus 4 MPa
  const auto rows = through({{0.001, 10e6},
                             {0.0011, 0.96 * 14e6 - confinement},
                             {0.0012, 12e6},
                             {0.0013, 0.92 * 16e6 - confinement},
                             {0.002, 20e6},
                             {0.003, 8e6}});
  CHECK(stress_at_first_drop(rows, 0.05).value() == 16e6);
  CHECK(stress_at_first_drop(rows, 0.03).value() == 14e6);
  CHECK(stress_at_first_drop(rows, 0.10).value() == 24e6);
  CHECK(!stress_at_first_drop(rows, 0.6));
  CHECK(!stress_at_first_drop({}, 0.05));
}

TEST_CASE(
    "strength: bulk modulus: mean stress over volumetric strain between 5 and 25 % of the pressure [rel "
    "1e-12]") {
  std::vector<CurveRow> rows;
  for (int k = 0; k <= 1000; ++k) {
    CurveRow r;
    r.confining_stress_Pa = 1e5 * k;      // to 100 MPa
    r.axial_stress_Pa = 1.2e5 * k + 1e6;  // the platens feel something else
    const double mean = (r.axial_stress_Pa + 2 * r.confining_stress_Pa) / 3;
    // bedding first, crushing later
    r.volumetric_strain = k <= 45 ? 1e-5 * k : k <= 260 ? 0.01 + mean / 15e9 : 0.05 + mean / 4e9;
    rows.push_back(r);
  }
  CHECK(bulk_modulus(rows).value() == doctest::Approx(15e9).epsilon(1e-9));
  CHECK(!bulk_modulus({}));
  CHECK(!bulk_modulus(std::span(rows).first(3)));
}

TEST_CASE("strength: direct shear: tau = c + sigma tan phi through its strengths and off it [rel 1e-12]") {
  const double tan_phi = std::tan(32 * std::numbers::pi / 180);
  const std::vector<double> normal{1e6, 3e6, 10e6};
  std::vector<double> strength;
  for (const double s : normal) strength.push_back(4e6 + s * tan_phi);
  const auto line = fit_shear_line(normal, strength).value();
  CHECK(line.friction_angle_deg == doctest::Approx(32).epsilon(1e-12));
  CHECK(line.cohesion_Pa == doctest::Approx(4e6).epsilon(1e-12));
  CHECK(line.residual_Pa < 1e-6);
  CHECK(line.peaks == 3);
  const std::vector<double> twice{1e6, 1e6, 3e6, 3e6},
      off{5e6, 7e6, 7e6, 9e6};  // 5 MPa + sigma, all 1 MPa off
  const auto rough = fit_shear_line(twice, off).value();
  CHECK(rough.friction_angle_deg == doctest::Approx(45).epsilon(1e-12));
  CHECK(rough.cohesion_Pa == doctest::Approx(5e6).epsilon(1e-12));
  CHECK(rough.residual_Pa == doctest::Approx(1e6).epsilon(1e-12));
  const std::vector<double> one{1e6}, same{1e6, 1e6}, two{2e6, 3e6};
  CHECK(!fit_shear_line(one, one));
  CHECK(!fit_shear_line(same, two));
}
