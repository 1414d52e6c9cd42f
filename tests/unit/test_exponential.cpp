// The exponential law: against closed forms of docs/model.md, "Exponential", one number at a time
// and in wide registers.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

#include "kernels/laws/exponential.hpp"
#include "tests/follow.hpp"

using namespace breccia;
using reference::PathPoint;
using scene::Outcome, scene::Path;
namespace stdx = std::experimental;

namespace {

constexpr double exact = 1e-12;
constexpr Features features{.criterion = Criterion::mohr_coulomb};

struct Set {  ///< the standard set of docs/model.md, "Exponential"
  double E = 30e9, e_max = 0.002, g1 = 0.2, g2 = 16, g3 = 0.275, sigma_t = 10e6, C = 13e6;
  double tan_i = std::tan(30 * 3.14159265358979 / 180), tan_c = 0.4, kappa = 1 / 2.4, delta_n = 0,
         delta_s = 0;
};

ExponentialLaw law(const Set& s) {
  Material m;
  m.young_modulus = s.E;
  m.tensile_strength = s.sigma_t;
  m.shear_strength = s.C;
  m.friction_static = s.tan_i;
  m.friction_dynamic = s.tan_c;
  m.damage_normal = s.delta_n;
  m.damage_shear = s.delta_s;
  m.own = {{"elastic_strain_limit", s.e_max},
           {"hardening_factor", s.g1},
           {"hardening_rate", s.g2},
           {"hardening_floor", s.g3}};
  return ExponentialLaw::of(m, s.kappa);
}

/// Lanes with different areas and lengths.
std::vector<BondConstants<double>> several_bonds(const Set& s) {
  std::vector<BondConstants<double>> bonds;
  for (const auto& [d0, area] :
       {std::pair{0.02, 3e-4}, {0.0325, 1e-4}, {0.004, 8e-4}, {0.015, 5e-5}, {0.05, 2e-3}})
    bonds.push_back({d0, area, area, s.E * area / d0, 0.0});
  return bonds;
}

/// Outcomes along paths in every kind of register.
template <class Check>
void in_every_width(const Set& s, const std::vector<BondConstants<double>>& bonds,
                    const std::vector<Path>& paths, const Check& check) {
  check("double", scene::follow<features, double>(law(s), bonds, paths));
  check("native", scene::follow<features, stdx::native_simd<double>>(law(s), bonds, paths));
  check("8 lanes", scene::follow<features, stdx::fixed_size_simd<double, 8>>(law(s), bonds, paths));
}

/// Stress over the envelope, straight from the formula (B26).
double envelope(const Set& s, double e) {
  if (e <= s.e_max) return s.E * e;
  const double K2 = std::min(s.E, s.E * s.g3 + s.E * s.g1 * std::exp(s.g2 * (e - s.e_max)));
  return s.E * s.e_max + K2 * (e - s.e_max);
}

Path ramp(const BondConstants<double>& b, const std::vector<double>& strains, int steps) {
  Path path;
  double from = 0;
  for (const double to : strains) {
    for (int k = 1; k <= steps; ++k) {
      const double u = -b.rest_length * (from + (to - from) * k / steps);
      path.push_back({(b.rest_length + u) - b.rest_length, 0, 0});  // as the difference of two lengths can be
    }
    from = to;
  }
  return path;
}

double strain_at(const BondConstants<double>& b, const PathPoint& q) { return -q.u / b.rest_length; }

}  // namespace

TEST_CASE("lanes: exponential() is std::exp from -6 to 6 [rel 1e-14] and 1 at 0 [exact]") {
  double worst = 0, wide = 0;
  for (int k = -6000; k <= 6000; k += 7) {
    const double x = 1e-3 * k + 1e-5 * (k % 13), want = std::exp(x);
    worst = std::max(worst, std::abs(exponential(x) / want - 1));
    const stdx::native_simd<double> four([&](auto lane) { return x - 0.25 * double(lane); });
    const auto got = exponential(four);
    for (std::size_t j = 0; j < got.size(); ++j) {
      if (x - 0.25 * double(j) < -6) continue;
      wide = std::max(wide, std::abs(got[j] / std::exp(x - 0.25 * double(j)) - 1));
    }
  }
  CHECK(worst < 1e-14);
  CHECK(wide < 1e-14);
  CHECK(exponential(0.0) == 1.0);
}

TEST_CASE(
    "exponential law: the envelope - from the elastic part over the falling secant to its rise [(B25) "
    "1e-12]") {
  const Set s;
  const auto bonds = several_bonds(s);
  std::vector<Path> paths;
  for (const auto& b : bonds) paths.push_back(ramp(b, {0.001, 0.002, 0.0021, 0.005, 0.02, 0.046}, 40));
  // the numbers themselves, once: E 30 GPa, 1 % beyond e_max: 60 MPa + 30 GPa (0.275 + 0.2
  // exp(0.16)) 0.01
  CHECK(envelope(s, 0.012) ==
        doctest::Approx(60e6 + 30e9 * (0.275 + 0.2 * 1.1735108709918103) * 0.01).epsilon(1e-12));
  CHECK(envelope(s, 0.012) < 0.6 * s.E * 0.012);
  in_every_width(s, bonds, paths, [&](const char* width, const std::vector<std::vector<Outcome>>& got) {
    double worst = 0, across = 0;
    for (std::size_t k = 0; k < bonds.size(); ++k)
      for (std::size_t n = 0; n < paths[k].size(); ++n) {
        const double want = -bonds[k].area * envelope(s, strain_at(bonds[k], paths[k][n]));
        const double miss = std::abs(got[k][n].force.x - want) / (s.E * s.e_max * bonds[k].area);
        worst = miss <= worst ? worst : miss;
        across = std::max(across, std::abs(got[k][n].force.y) + std::abs(got[k][n].force.z));
      }
    INFO(width);
    CHECK(worst < exact);
    CHECK(across == 0);
  });
}

TEST_CASE("exponential law: no jump in force anywhere - never stiffer than k_n - K2 at most k_n [(B25)]") {
  const Set s;
  const BondConstants<double> b = several_bonds(s)[0];
  const Path path = ramp(b, {0.2}, 40000);
  const auto got = scene::follow<features, double>(law(s), {b}, {path})[0];
  double steepest = 0;
  for (std::size_t n = 1; n < path.size(); ++n)
    steepest =
        std::max(steepest, std::abs((got[n].force.x - got[n - 1].force.x) / (path[n].u - path[n - 1].u)));
  CHECK(steepest <= b.stiffness * (1 + 1e-6));
  CHECK(steepest >= b.stiffness * (1 - 1e-6));
  for (const double e : {0.0826, 0.1, 1.0, 100.0})
    CHECK(secant_ratio(law(s), e) == doctest::Approx(1).epsilon(1e-14));
  CHECK(secant_ratio(law(s), 0.0820) < 1);
  CHECK(secant_ratio(law(s), 0.002) == doctest::Approx(0.475).epsilon(1e-14));
  // where the envelope is steeper than k_n the bond goes elastically: from the strain at which g3 +
  // g1 (1 + x) e^x = 1, x = g2 (e - e_max), found here by bisection
  double low = 0, high = 2;
  for (int k = 0; k < 100; ++k) {
    const double x = 0.5 * (low + high);
    (s.g3 + s.g1 * (1 + x) * std::exp(x) < 1 ? low : high) = x;
  }
  const double turn = s.e_max + low / s.g2;
  CHECK(turn == doctest::Approx(0.048).epsilon(0.01));
  const double want = b.area * (envelope(s, turn) + s.E * (0.2 - turn));
  CHECK(-got.back().force.x ==
        doctest::Approx(want).epsilon(1e-6));  // a step of 5e-6 of strain may miss the turn
  // a set whose secant never falls is a spring
  for (const auto& [g1, g3] : {std::pair{0.3, 0.9}, {0.0, 1.0}, {2.0, 0.0}}) {
    Set stiff = s;
    stiff.g1 = g1, stiff.g3 = g3;
    for (const double e : {0.0021, 0.03}) CHECK(secant_ratio(law(stiff), e) == 1);
    const auto spring = scene::follow<features, double>(law(stiff), {b}, {ramp(b, {0.05}, 20)})[0].back();
    CHECK(-spring.force.x == doctest::Approx(s.E * b.area * 0.05).epsilon(1e-12));
  }
  Set flat = s;  // no exponential part: a straight line of slope g3 k_n
  flat.g1 = 0;
  const auto line = scene::follow<features, double>(law(flat), {b}, {ramp(b, {0.3}, 500)})[0].back();
  CHECK(-line.force.x == doctest::Approx(s.E * b.area * (0.002 + 0.275 * 0.298)).epsilon(1e-12));
}

TEST_CASE(
    "exponential law: unloading with k_n through u_p - tension from there - reloading to the envelope "
    "[(B26) 1e-12]") {
  for (const double delta : {0.0, 0.5}) {
    Set s;
    s.delta_n = delta;
    const auto bonds = several_bonds(s);
    std::vector<Path> paths;
    const double e = 0.03, e_p = e - envelope(s, e) / s.E, e_t = s.sigma_t / s.E;
    REQUIRE(e_p > 10 * e_t);
    for (const auto& b : bonds)
      paths.push_back(ramp(b,
                           {e, e_p + 0.3 * (e - e_p), e_p, e_p - 0.99 * e_t, 0.9 * e, e, 0.035, e_p,
                            0.035 - envelope(s, 0.035) / s.E - (1 + 0.5 * delta) * 1.0000001 * e_t, 0.0},
                           30));
    in_every_width(s, bonds, paths, [&](const char* width, const std::vector<std::vector<Outcome>>& got) {
      double worst = 0;
      for (std::size_t k = 0; k < bonds.size(); ++k) {
        double deepest = 0, top = 0;
        for (std::size_t n = 0; n < paths[k].size(); ++n) {
          const double now = strain_at(bonds[k], paths[k][n]);
          deepest = std::max(deepest, now);
          const double pull = deepest - envelope(s, deepest) / s.E - now;  // elastic, positive in tension
          top = std::max(top, pull / e_t);
          double want = s.E * pull;
          if (pull > 0 && top > 1)  // softening: linear to zero at 1 + delta, secant back
            want *= delta > 0 && top < 1 + delta ? (1 + delta - top) / delta / top : 0.0;
          const double miss =
              std::abs(got[k][n].force.x - want * bonds[k].area) / (s.E * s.e_max * bonds[k].area);
          worst = miss <= worst ? worst : miss;
        }
        CHECK(got[k].back().history.plastic_stretch ==
              doctest::Approx(-bonds[k].rest_length * (0.035 - envelope(s, 0.035) / s.E)).epsilon(1e-10));
        CHECK((got[k].back().history.damage_normal >= 1) == true);
      }
      INFO(width, ", delta ", delta);
      CHECK(worst < exact);
    });
  }
}

TEST_CASE(
    "exponential law: shear strength C A - F_n tan phi for either sign of F_n - then N tan phi_c [(B27) "
    "1e-12]") {
  const Set s;
  const auto bonds = several_bonds(s);
  for (const double stress : {-40e6, -8e6, 0.0, 4e6, 9e6}) {  // of the bond, tension positive
    std::vector<Path> paths;
    for (const auto& b : bonds) {
      const double S = s.C - stress * s.tan_i, y = S * b.area / (s.kappa * b.stiffness);
      const double u = (b.rest_length + stress * b.area / b.stiffness) - b.rest_length;
      paths.push_back(
          {{u, 0, 0}, {u, 0.3 * y, 0}, {u, 0, 0.999999 * y}, {u, 0, 1.000001 * y}, {u, 0, 1.5 * y}});
    }
    const double S = s.C - stress * s.tan_i, R = s.tan_c * std::max(-stress, 0.0);
    REQUIRE(R < S);
    in_every_width(s, bonds, paths, [&](const char* width, const std::vector<std::vector<Outcome>>& got) {
      INFO(width, ", stress ", stress);
      for (std::size_t k = 0; k < bonds.size(); ++k) {
        const double A = bonds[k].area, kept = stress > 0 ? 0.0 : stress;
        const std::vector<Vec3> want{
            {stress, 0, 0}, {stress, 0.3 * S, 0}, {stress, 0, 0.999999 * S}, {kept, 0, R}, {kept, 0, R}};
        for (std::size_t n = 0; n < want.size(); ++n)
          CHECK(norm(got[k][n].force - A * want[n]) < 1e-9 * A * S);
        CHECK(got[k][2].history.damage_shear == 0);
        CHECK(got[k][3].history.damage_shear == 1);
        CHECK(got[k][3].history.damage_normal == 0);
      }
    });
  }
}

TEST_CASE(
    "exponential law: wide registers give what single numbers give on random paths [1e-13 of the strength]") {
  Set s;
  s.delta_n = 0.4, s.delta_s = 0.7;
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> in(-1, 1);
  std::vector<BondConstants<double>> bonds;
  std::vector<Path> paths;
  for (int k = 0; k < 101; ++k) {
    bonds.push_back(several_bonds(s)[std::size_t(k % 5)]);
    const auto& b = bonds.back();
    PathPoint at;
    Path path;
    for (int n = 0; n < 300; ++n) {
      const double wild = n % 50 == 0 ? 8 : 1;
      at.u += b.rest_length * 4e-4 * wild * (in(random)-0.2);
      at.y += 4e-4 * b.rest_length * wild * in(random), at.z += 4e-4 * b.rest_length * wild * in(random);
      path.push_back(at);
    }
    paths.push_back(path);
  }
  const auto one = scene::follow<features, double>(law(s), bonds, paths);
  int tension = 0, shear = 0, plastic = 0;
  for (const auto& path : one) {
    tension += path.back().history.damage_normal >= 1;
    shear += path.back().history.damage_shear >= 1;
    plastic += path.back().history.plastic_stretch < 0;
  }
  CHECK(tension > 5);
  CHECK(shear > 5);
  CHECK(plastic > 20);
  const auto same = [&](const auto& wide) {
    double worst = 0;
    for (std::size_t k = 0; k < bonds.size(); ++k)
      for (std::size_t n = 0; n < paths[k].size(); ++n) {
        const double miss = norm(wide[k][n].force - one[k][n].force) / (s.C * bonds[k].area);
        worst = miss <= worst ? worst : miss;
      }
    return worst;
  };
  CHECK(same(scene::follow<features, stdx::native_simd<double>>(law(s), bonds, paths)) < 1e-13);
  CHECK(same(scene::follow<features, stdx::fixed_size_simd<double, 8>>(law(s), bonds, paths)) < 1e-13);
}
