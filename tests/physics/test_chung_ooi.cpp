// The eight impacts of Chung and Ooi, Granular Matter 13 (2011) 643-656. Closed forms: Hertz; the
// coefficient of restitution; gross sliding, v_t' = v_t - mu (1 + e) v_n and R w' = 5/2 mu (1 + e)
// v_n. They take the sphere as round, our arm is the centre's present distance from the wall: a
// spin is smaller by overlap/radius, 0.5 % in test 5.
//
// Where spheres stick there is no closed form, and the paper's curves come from codes that pull at
// the end of a damped impact. Reading error of a curve: the largest difference from the closed form
// where that holds (it should be none).
#include <doctest/doctest.h>

#include <numbers>

#include "impact_scenes.hpp"

using namespace breccia;
using namespace scene;

namespace {

const ImpactMaterial glass{2800, 48e9, 0.20, 0.35, 1.0}, alloy{2699, 70e9, 0.30, 0, 1.0},
    oxide{4000, 380e9, 0.23, 0.092, 0.98}, steel{7850, 208e9, 0.30, 0.3, 1.0},
    rough_alloy{2700, 70e9, 0.33, 0.4, 0.5}, nylon{1000, 2.5e9, 0.40, 0.4, 0.5};

double degrees(double angle) { return angle * std::numbers::pi / 180; }

/// Linear between the rows.
double force_at(const std::vector<ImpactRow>& rows, double time) {
  for (std::size_t k = 1; k < rows.size(); ++k)
    if (rows[k].time_s >= time) {
      const double part = (time - rows[k - 1].time_s) / (rows[k].time_s - rows[k - 1].time_s);
      return rows[k - 1].normal_force_N + part * (rows[k].normal_force_N - rows[k - 1].normal_force_N);
    }
  return 0;
}

double worst_force(const std::string& file, const std::vector<ImpactRow>& rows) {
  double worst = 0;
  for (const Point& p : digitised(file))
    worst = std::max(worst, std::abs(force_at(rows, p.x * 1e-6) - p.y * 1e3));
  return worst;
}

ImpactRecord hit(const ImpactMaterial& m, double radius, const Vec3& v, const Vec3& w = {},
                 HertzForm form = HertzForm::dissipative) {
  ImpactScene s = sphere_on_plane(m, radius, v, w);
  s.form = form;
  const ImpactResult r = run(s);
  REQUIRE(r.open_contacts == 0);
  return r.particles[0];
}

/// Tests 6 and 8: ratio of the contact point's speed after and before, reversed, for x = 7 mu (1 +
/// e) V_n/(2 V_t).
double beta(const ImpactMaterial& m, double x, HertzForm form = HertzForm::dissipative) {
  const double radius = 0.1, normal = 0.2, slip = 3.5 * m.friction * (1 + m.restitution) * normal / x;
  const ImpactRecord p = hit(m, radius, {0, 0, -normal}, {0, -slip / radius, 0}, form);
  return -(p.velocity.x - p.spin.y * radius) / slip;
}

ImpactRecord angled(double angle, HertzForm form = HertzForm::dissipative) {
  return hit(oxide, 0.0025, {3.9 * std::sin(degrees(angle)), 0, -3.9 * std::cos(degrees(angle))}, {}, form);
}

}  // namespace

TEST_CASE("chung-ooi 1: two glass spheres head on [Hertz 1e-3 - digitised curve within 1 % of the peak]") {
  const ImpactResult r = run(head_on(glass, 0.01, 10));
  const ImpactRecord& p = r.particles[0];
  CHECK(p.largest_overlap == doctest::Approx(2.74112702e-4).epsilon(1e-3));
  CHECK(p.largest_force == doctest::Approx(1.06968890e4).epsilon(1e-3));
  CHECK(p.contact_time == doctest::Approx(4.03394557e-5).epsilon(1e-3));
  CHECK(p.velocity.x == doctest::Approx(-10).epsilon(1e-6));
  CHECK(r.kinetic_after == doctest::Approx(r.kinetic_before).epsilon(1e-6));
  if (digitised("chung_ooi_test1_force_time.csv").empty()) {
    MESSAGE("skipped 'chung_ooi_test1_force_time.csv is not here'");
    return;
  }
  CHECK(worst_force("chung_ooi_test1_force_time.csv", r.rows) < 0.01 * p.largest_force);
}

TEST_CASE("chung-ooi 2: a sphere on a rigid plane [Hertz 1e-3 - digitised curve within 1 % of the peak]") {
  const ImpactResult r = run(sphere_on_plane(alloy, 0.1, {0, 0, -0.2}));
  const ImpactRecord& p = r.particles[0];
  CHECK(p.largest_overlap == doctest::Approx(4.97171752e-5).epsilon(1e-3));
  CHECK(p.largest_force == doctest::Approx(1.13698583e4).epsilon(1e-3));
  CHECK(p.contact_time == doctest::Approx(7.31656641e-4).epsilon(1e-3));
  CHECK(p.velocity.z == doctest::Approx(0.2).epsilon(1e-6));
  if (digitised("chung_ooi_test2_force_time.csv").empty()) {
    MESSAGE("skipped 'chung_ooi_test2_force_time.csv is not here'");
    return;
  }
  CHECK(worst_force("chung_ooi_test2_force_time.csv", r.rows) < 0.01 * p.largest_force);
}

TEST_CASE("chung-ooi 3: the rebound speed is e times the approach speed [1e-3 of it]") {
  for (const double e : {0.2, 0.4, 0.6, 0.8, 1.0})
    for (const HertzForm form : {HertzForm::dissipative, HertzForm::classic}) {
      ImpactMaterial m = oxide;
      m.friction = 0, m.restitution = e;
      CHECK(hit(m, 0.0025, {0, 0, -3.9}, {}, form).velocity.z / 3.9 == doctest::Approx(e).epsilon(1e-3));
    }
}

TEST_CASE("chung-ooi 4: oblique at constant speed [gross sliding 5e-3 - digitised curve 2 %]") {
  const double spin_scale = 2.5 * 0.092 * 1.98 * 3.9 / 0.0025;  // 1/s: R w' = 5/2 mu (1 + e) v_n
  for (const double angle : {40., 50., 60., 70., 80., 85.}) {
    const double vn = 3.9 * std::cos(degrees(angle)), vt = 3.9 * std::sin(degrees(angle));
    const ImpactRecord p = angled(angle);
    CHECK(p.velocity.x == doctest::Approx(vt - 0.092 * 1.98 * vn).epsilon(5e-3));
    CHECK(p.spin.y == doctest::Approx(spin_scale * std::cos(degrees(angle))).epsilon(5e-3));
    CHECK(p.velocity.z == doctest::Approx(0.98 * vn).epsilon(5e-3));
  }
  const auto curve = digitised("chung_ooi_test4_angular_velocity.csv", "Al. oxide");
  if (curve.empty()) {
    MESSAGE("skipped 'chung_ooi_test4_angular_velocity.csv is not here'");
    return;
  }
  double reading = 0, classic = 0, ours = 0;
  for (const Point& p : curve) {
    const double angle = 5 * std::round(p.x / 5);  // what was drawn: the reading error of x is 0.09 degrees
    if (angle >= 40) reading = std::max(reading, std::abs(-p.y - spin_scale * std::cos(degrees(angle))));
    classic = std::max(classic, std::abs(-p.y - angled(angle, HertzForm::classic).spin.y));
    ours = std::max(ours, std::abs(-p.y - angled(angle).spin.y));
  }
  MESSAGE("spin, 1/s: reading error " << reading << ", classic " << classic << ", dissipative " << ours);
  // the curve can be read to 0.5 % of its largest spin, 617/s; where the sphere sticks, between 5
  // and 25 degrees, its codes are not known well enough to be met closer than 2 %, and ours, which
  // gains no energy, lies 5 % off
  CHECK(reading < 0.006 * 617);
  CHECK(classic < 0.02 * 617);
  CHECK(ours < 0.05 * 617);
}

TEST_CASE("chung-ooi 5: normal speed constant tangential speed varied [gross sliding 1e-2]") {
  const double radius = 1e-5, unit = 0.3 * 5.0;  // m/s: mu V_n
  for (const double x : {8.0, 10.0, 13.0, 20.0}) {
    const ImpactRecord p = hit(steel, radius, {x * unit, 0, -5});
    CHECK((p.velocity.x - radius * p.spin.y) / unit == doctest::Approx(x - 7).epsilon(1e-2 * 7 / (x - 7)));
    CHECK(radius * p.spin.y / unit == doctest::Approx(5).epsilon(1e-2));
    CHECK(p.velocity.x / unit == doctest::Approx(x - 2).epsilon(1e-3));
  }
}

TEST_CASE("chung-ooi 6: spinning on a rigid plane [gross sliding 1e-2 - nylon's digitised curve]") {
  for (const double x : {0.15, 0.3, 0.5}) CHECK(beta(rough_alloy, x) == doctest::Approx(x - 1).epsilon(1e-2));
  const auto curve = digitised("chung_ooi_test6_beta.csv", "Nylon");
  if (curve.empty()) {
    MESSAGE("skipped 'chung_ooi_test6_beta.csv is not here'");
    return;
  }
  double reading = 0, worst = 0;
  for (const Point& p : curve) {
    if (p.x < 0.8) reading = std::max(reading, std::abs(p.y - (p.x - 1)));
    worst = std::max(worst, std::abs(p.y - beta(nylon, p.x, HertzForm::classic)));
  }
  MESSAGE("beta: reading error " << reading << ", classic " << worst);
  CHECK(worst < 2 * reading);
}

TEST_CASE(
    "chung-ooi 7: equal spheres with equal spins part without tangential velocity spins as before [1e-9]") {
  for (const double spin : {0.175, 1.155, 5.495, 22.86}) {
    ImpactScene s = head_on(rough_alloy, 0.1, 0.2);
    s.particles[0].spin = s.particles[1].spin = {0, 0, spin};
    s.duration *= 2;
    const ImpactResult r = run(s);
    CHECK(r.open_contacts == 0);
    // equal spins slide against each other: friction turns both by the same torque and pushes them
    // apart sideways
    CHECK(r.particles[0].spin.z == doctest::Approx(r.particles[1].spin.z).epsilon(1e-12));
    CHECK(r.particles[0].velocity.y == doctest::Approx(-r.particles[1].velocity.y).epsilon(1e-12));
    s.particles[1].spin = {0, 0, -spin};  // opposite spins roll on each other
    const ImpactResult rolling = run(s);
    CHECK(rolling.particles[0].spin.z == doctest::Approx(spin).epsilon(1e-9));
    CHECK(std::abs(rolling.particles[0].velocity.y) < 1e-9);
    CHECK(rolling.particles[0].velocity.x == doctest::Approx(-0.1).epsilon(1e-3));
  }
}

TEST_CASE(
    "chung-ooi 8: a spinning sphere on one five times as large and a thousand times as dense [1e-2 of test "
    "6]") {
  const double radius = 0.1, normal = 0.2;
  ImpactMaterial heavy = rough_alloy;
  heavy.density *= 1e3, heavy.young_modulus *= 1e3;
  for (const double x : {0.3, 0.5, 1.5, 4.0}) {
    const double slip = 3.5 * 0.4 * 1.5 * normal / x;
    ImpactScene s = sphere_on_plane(rough_alloy, radius, {0, 0, -normal}, {0, -slip / radius, 0});
    s.materials[1] = heavy;
    s.walls.clear();
    s.particles.push_back({{0, 0, -0.5}, {}, {}, 0.5, 1});
    const ImpactResult r = run(s);
    REQUIRE(r.open_contacts == 0);
    const ImpactRecord& p = r.particles[0];
    const double b = -(p.velocity.x - p.spin.y * radius) / slip;
    CHECK(std::abs(b - beta(rough_alloy, x)) < 1e-2);
    if (x < 1) CHECK(b == doctest::Approx(x - 1).epsilon(1e-2));
  }
}
