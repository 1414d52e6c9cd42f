// A bond that has yielded goes back on a stiffer line than it came (docs/model.md, B118).
#include <doctest/doctest.h>

#include "kernels/loops/bond_energy.hpp"
#include "tests/follow.hpp"
#include "tests/scene.hpp"

using namespace breccia;
namespace ref = breccia::reference;

namespace {

constexpr Features uncoupled{.unloading = true};

struct Sample {
  ref::Parameters p;
  ref::Bond b;
  DempackLaw law;
  double L;
};

Sample sample(double unloads, double onset) {
  ref::Parameters p;
  p.unloads = unloads;
  p.yield_stress = onset;
  const ref::Bond b =
      ref::make_bond(p, {ref::sphere(p, 1, 0.01, {}), ref::sphere(p, 2, 0.012, {0.021, 0, 0})}, 0, 1);
  return {p, b, scene::law(p), b.strain_length};
}

BondConstants<double> constants_of_bond(const ref::Bond& b) { return {b.d0, b.area, b.area, b.k_n, b.c_n}; }

/// Pulled and pressed along straight pieces to these stretches, m.
scene::Path along(const std::vector<double>& corners, int steps) {
  scene::Path path;
  double from = 0;
  for (const double to : corners) {
    for (int k = 1; k <= steps; ++k) path.push_back({from + (to - from) * k / steps, 0, 0});
    from = to;
  }
  return path;
}

std::vector<scene::Outcome> follow(const Sample& s, const scene::Path& path) {
  return scene::follow<uncoupled, double>(s.law, {constants_of_bond(s.b)}, {path})[0];
}

/// Pa, slope by slope.
double envelope(const ref::Parameters& p, double e) {
  double from = 0, reached = 0, slope = p.E;
  for (int k = 0; k < 3; ++k) {
    const double to = from + (p.LCS[k] - reached) / slope;
    if (e <= to) break;
    from = to, reached = p.LCS[k], slope = p.E / p.YRC[k];
  }
  return reached + slope * (e - from);
}

}  // namespace

TEST_CASE("unloading/one bond: k_u back and forth, k_n in tension, from the onset on [(B118), closed form]") {
  for (const double onset : {0.0, 28e6}) {
    const Sample s = sample(2.0, onset);
    const double A = s.b.area, k = s.b.k_n;
    const double e1 = s.p.LCS[0] / s.p.E, e = 3 * e1, F = envelope(s.p, e) * A;
    REQUIRE(F > onset * A);
    const double zero = -e * s.L + F / (2 * k);  // where the line back meets no force
    const auto end = [&](double u) { return follow(s, along({-e * s.L, u}, 50)).back(); };
    CHECK(end(-e * s.L).force.x == doctest::Approx(-F).epsilon(1e-12));
    CHECK(end(-e * s.L + 0.25 * F / k).force.x == doctest::Approx(-0.5 * F).epsilon(1e-12));
    CHECK(end(zero).force.x == doctest::Approx(0).scale(F).epsilon(1e-12));
    CHECK(end(zero + 1e-5 * s.L).force.x == doctest::Approx(1e-5 * s.L * k).epsilon(1e-9));
    const auto again = follow(s, along({-e * s.L, zero, -1.2 * e * s.L}, 600));
    CHECK(again.back().force.x == doctest::Approx(-envelope(s.p, 1.2 * e) * A).epsilon(1e-12));
    // below the onset a bond goes back the way it came
    if (onset == 0.0) continue;
    const double below = 1.2 * e1;
    REQUIRE(envelope(s.p, below) < onset);
    const auto curve = follow(s, along({-below * s.L, -1.1 * e1 * s.L}, 40));
    CHECK(curve.back().force.x == doctest::Approx(-envelope(s.p, 1.1 * e1) * A).epsilon(1e-12));
    CHECK(curve.back().history.plastic_stretch == 0);
  }
}

TEST_CASE("unloading/energy: what a path costs is the area between its lines [(B118), O(du^2)]") {
  for (const double onset : {0.0, 28e6}) {
    const Sample s = sample(2.0, onset);
    const BondConstants<double> c = constants_of_bond(s.b);
    const double A = s.b.area, k = s.b.k_n, e = 0.02, F = envelope(s.p, e) * A;
    double area = 0;
    constexpr int fine = 200000;
    for (int n = 0; n < fine; ++n) area += envelope(s.p, e * (n + 0.5) / fine) * A * e * s.L / fine;
    for (const double back : {0.0, 0.4, 1.0}) {
      constexpr int steps = 20000;
      const double u = -e * s.L + back * F / (2 * k);
      const auto path = along({-e * s.L, u}, steps);
      const auto out = follow(s, path);
      double work = 0;
      for (std::size_t n = 1; n < path.size(); ++n)
        work += 0.5 * (out[n - 1].force.x + out[n].force.x) * (path[n].u - path[n - 1].u);
      const double stored = stored_energy(s.law, c, out.back().history, s.b.d0 + u, false);
      CHECK(stored ==
            doctest::Approx(0.25 * F * F / k * (1 - back) * (1 - back)).epsilon(1e-9).scale(F * F / k));
      CHECK(work - stored == doctest::Approx(area - 0.25 * F * F / k).epsilon(1e-5));
    }
    // not yet yielded: all comes back
    if (onset == 0.0) continue;
    const double below = 1.2 * s.p.LCS[0] / s.p.E;
    const auto out = follow(s, along({-below * s.L}, 40));
    double curve = 0;
    for (int n = 0; n < fine; ++n) curve += envelope(s.p, below * (n + 0.5) / fine) * A * below * s.L / fine;
    CHECK(stored_energy(s.law, c, out.back().history, s.b.d0 - below * s.L, false) ==
          doctest::Approx(curve).epsilon(1e-9));
  }
}
