// The reference solver against closed forms of docs/model.md: nothing here calls what it checks.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>
#include <vector>

#include "tests/reference/reference.hpp"

using namespace breccia;
using namespace breccia::reference;

namespace {

constexpr double exact = 1e-12;

Bond unit_bond(const Parameters& p) {  // two touching spheres of 1 cm: area pi cm^2, d0 2 cm
  return make_bond(p, {sphere(p, 1, 0.01, {}), sphere(p, 2, 0.01, {0.02, 0, 0})}, 0, 1);
}

double stretch_limit(const Parameters& p, const Bond& b) { return p.sigma_t * b.area / b.k_n; }
double shear_limit(const Parameters& p, const Bond& b) { return p.tau_f * b.area / b.k_s; }

/// Points on straight lines between corners, `steps` to each line, the corners themselves included.
std::vector<PathPoint> along(std::vector<PathPoint> corners, int steps) {
  std::vector<PathPoint> path;
  PathPoint from;
  for (const PathPoint& to : corners) {
    for (int k = 1; k <= steps; ++k) {
      const double t = double(k) / steps;
      path.push_back({(1 - t) * from.u + t * to.u, (1 - t) * from.y + t * to.y, (1 - t) * from.z + t * to.z});
    }
    from = to;
  }
  return path;
}

/// Largest |computed - expected| over the path, in units of `scale`.
template <class Computed, class Expected>
double deviation(const std::vector<PathPoint>& path, const std::vector<Bond>& bonds, double scale,
                 Computed computed, Expected expected) {
  double worst = 0;
  for (std::size_t k = 0; k < path.size(); ++k)
    worst = std::max(worst, std::abs(computed(bonds[k]) - expected(path[k])) / scale);
  return worst;
}

double normal(const Bond& b) { return b.normal_force; }
double shear_y(const Bond& b) { return b.shear_force.y; }

/// Work along the path by the trapezoid, forces at 0 included.
double work(const std::vector<PathPoint>& path, const std::vector<Bond>& bonds) {
  double sum = 0;
  PathPoint a;
  Bond f;
  for (std::size_t k = 0; k < path.size(); a = path[k], f = bonds[k], ++k) {
    sum += 0.5 * (f.normal_force + bonds[k].normal_force) * (path[k].u - a.u);
    sum += 0.5 * (f.shear_force.y + bonds[k].shear_force.y) * (path[k].y - a.y);
    sum += 0.5 * (f.shear_force.z + bonds[k].shear_force.z) * (path[k].z - a.z);
  }
  return sum;
}

double three_slopes(const Parameters& p, double e) {  // written from the corners, not from the slopes
  const double E = p.E;
  const double e1 = p.LCS[0] / E;
  const double e2 = e1 + p.YRC[0] * (p.LCS[1] - p.LCS[0]) / E;
  const double e3 = e2 + p.YRC[1] * (p.LCS[2] - p.LCS[1]) / E;
  if (e < e1) return p.LCS[0] * (e / e1);
  if (e < e2) return std::lerp(p.LCS[0], p.LCS[1], (e - e1) / (e2 - e1));
  if (e < e3) return std::lerp(p.LCS[1], p.LCS[2], (e - e2) / (e3 - e2));
  return p.LCS[2] + E * (e - e3) / p.YRC[2];
}

/// Secant-unloading, linear-softening force of magnitude path x with largest |x| so far in `top`.
double softened(double k, double limit, double delta, double x, double& top) {
  top = std::max(top, x);
  if (top <= limit) return k * x;
  const double end = limit * (1 + delta);
  if (top >= end) return 0;
  return k * limit * (end - top) / (end - limit) * (x / top);
}

}  // namespace

TEST_CASE("reference/bond: stiffness, damping and ends of a new bond [section 2]") {
  Parameters p;
  p.alpha = 0.8;
  const std::vector<Particle> two{sphere(p, 7, 0.02, {0.032, 0, 0}), sphere(p, 3, 0.01, {})};
  const Bond b = make_bond(p, two, 0, 1);
  CHECK(b.i == 1);  // the lower id first
  CHECK(b.j == 0);
  CHECK(make_bond(p, two, 1, 0).i == 1);
  const double A = 0.8 * std::numbers::pi * 1e-4;
  CHECK(b.area == doctest::Approx(A).epsilon(exact));
  CHECK(b.k_n == doctest::Approx(p.E * A / 0.032).epsilon(exact));
  CHECK(b.k_s == doctest::Approx(b.k_n / 2.4).epsilon(exact));
  const double m = two[1].mass * 8.0 / 9.0;  // masses 1 : 8
  CHECK(b.c_n == doctest::Approx(1.8 * std::sqrt(m * b.k_n)).epsilon(exact));
  p.kappa = 0.5;
  CHECK(make_bond(p, two, 0, 1).k_s == doctest::Approx(b.k_n / 2).epsilon(exact));

  const Bond nested = make_bond(p, {sphere(p, 1, 0.02, {}), sphere(p, 2, 0.01, {0.001, 0, 0})}, 0, 1);
  CHECK(nested.d0 == doctest::Approx(0.001).epsilon(exact));
  CHECK(nested.k_n == doctest::Approx(p.E * A / 0.006).epsilon(exact));

  p.G_I = 100;
  p.G_II = 2000;
  const Bond given = make_bond(p, two, 0, 1);
  CHECK(given.delta_n == doctest::Approx(2 * p.E * 100 / (p.sigma_t * p.sigma_t * 0.032) - 1).epsilon(exact));
  CHECK(given.delta_s == doctest::Approx(2 * given.k_s * 2000 / (p.tau_f * p.tau_f * A) - 1).epsilon(exact));
  p.G_I = 1e-3;
  CHECK(make_bond(p, two, 0, 1).delta_n == 0);
}

TEST_CASE("reference/bond: who is bonded, and overlaps that are not [section 2]") {
  World world;
  const Parameters& p = world.parameters;
  const auto add = [&](int id, double x, int group) {
    world.particles.push_back(sphere(p, id, 0.5, {x, 0, 0}, group));
  };
  add(5, 0.0, 1), add(4, 1.09, 1), add(3, 2.20, 1), add(2, 3.1, 2), add(1, 4.0, 0), add(0, 4.9, 0);
  make_bonds(world);
  REQUIRE(world.bonds.size() == 1);  // gap 9 %; the next gap is 11 %, then groups differ or are 0
  CHECK(world.particles[world.bonds[0].i].id == 4);
  CHECK(world.contacts.size() == 3);
  CHECK(world.contacts.begin()->second.free_length == doctest::Approx(0.9));
  compute_forces(world, 1e-6);
  for (const Particle& a : world.particles) CHECK(norm(a.force) == 0);  // no explosion at step 1

  world.particles[5].x.x = 5.01;  // parted ...
  compute_forces(world, 1e-6);
  world.particles[5].x.x = 4.9;  // ... and back: now the overlap counts
  compute_forces(world, 1e-6);
  CHECK(world.particles[5].force.x == doctest::Approx(p.E * std::numbers::pi / 4 * 0.1).epsilon(1e-10));
  CHECK(world.particles[4].force.x == -world.particles[5].force.x);
}

TEST_CASE("reference/normal: three-slope envelope [section 3, rel 1e-12]") {
  const Parameters p;
  const Bond b = unit_bond(p);
  const auto path = along({{-0.06 * b.d0}}, 600);
  const auto bonds = bond_path(p, b, path);
  CHECK(deviation(path, bonds, p.LCS[2] * b.area, normal,
                  [&](PathPoint q) { return -b.area * three_slopes(p, -q.u / b.d0); }) < exact);
  CHECK(three_slopes(p, 0.06) > p.LCS[2]);  // all four branches were met
}

TEST_CASE("reference/normal: unloading and reloading with k_n, tension from u_p [section 3, rel 1e-12]") {
  const Parameters p;
  const Bond b = unit_bond(p);
  const double u_min = -0.008 * b.d0, u_l = stretch_limit(p, b);  // between LCS2 and LCS3
  const double u_p = u_min + b.area * three_slopes(p, 0.008) / b.k_n;
  REQUIRE(u_p < -10 * u_l);
  const double half = u_p + u_l * (1 + p.delta_n / 2);
  const std::vector<PathPoint> corners{{u_min}, {u_p},   {u_p + u_l},   {half},
                                       {u_p},   {u_min}, {1.5 * u_min}, {1.4 * u_min}};
  const auto path = along(corners, 50);
  const auto bonds = bond_path(p, b, path);
  const double scale = p.LCS[1] * b.area;
  double deepest = 0, plastic = 0, top = 0;
  CHECK(deviation(path, bonds, scale, normal, [&](PathPoint q) {
          if (q.u < deepest) {
            deepest = q.u;
            plastic = std::min(0.0, q.u + b.area * three_slopes(p, -q.u / b.d0) / b.k_n);
          }
          const double u_e = q.u - plastic;
          return u_e > 0 ? softened(b.k_n, u_l, p.delta_n, u_e, top) : b.k_n * u_e;
        }) < exact);
  CHECK(bonds[4 * 50 - 1].D_n == doctest::Approx(0.5).epsilon(1e-10));
  CHECK(bonds[3 * 50 - 1].normal_force == doctest::Approx(p.sigma_t * b.area).epsilon(1e-10));
  CHECK(bonds[2 * 50 - 1].u_p == doctest::Approx(u_p).epsilon(exact));
  CHECK(bonds.back().broken == Broken::no);
}

TEST_CASE(
    "reference/normal: softening, secant unloading, damage kept through compression [section 3, rel 1e-12]") {
  Parameters p;
  p.delta_n = 0.8;
  const Bond b = unit_bond(p);
  const double u_l = stretch_limit(p, b);
  const auto path =
      along({{1.2 * u_l}, {0.3 * u_l}, {1.3 * u_l}, {-u_l}, {1.31 * u_l}, {2 * u_l}, {-u_l}, {u_l}}, 97);
  const auto bonds = bond_path(p, b, path);
  double top = 0;
  CHECK(deviation(path, bonds, p.sigma_t * b.area, normal, [&](PathPoint q) {
          return q.u > 0 ? softened(b.k_n, u_l, 0.8, q.u, top) : b.k_n * q.u;
        }) < exact);
  CHECK(bonds[4 * 97 - 1].D_n == doctest::Approx(0.3 / 0.8).epsilon(exact));
  CHECK(bonds[4 * 97 - 1].broken == Broken::no);
  CHECK(bonds.back().broken == Broken::tension);
  CHECK(bonds.back().D_n == 1);
  CHECK(bonds.back().u_p == 0);
}

TEST_CASE("reference/law: delta = 0 breaks at once [sections 3 and 4, rel 1e-12]") {
  Parameters p;
  p.delta_n = p.delta_s = 0;
  const Bond b = unit_bond(p);
  const double u_l = stretch_limit(p, b), s_l = shear_limit(p, b);
  const std::vector<PathPoint> pull{{0.5 * u_l}, {0.999 * u_l}, {1.001 * u_l}, {0.5 * u_l}};
  const auto pulled = bond_path(p, b, pull);
  CHECK(pulled[1].normal_force == doctest::Approx(0.999 * p.sigma_t * b.area).epsilon(exact));
  CHECK(pulled[2].normal_force == 0);
  CHECK(pulled[3].normal_force == 0);
  CHECK(pulled[2].broken == Broken::tension);
  const std::vector<PathPoint> slide{{0.5 * u_l, 0}, {0.5 * u_l, 0.999 * s_l}, {0.5 * u_l, 1.001 * s_l}};
  const auto slid = bond_path(p, b, slide);
  CHECK(slid[1].shear_force.y == doctest::Approx(0.999 * p.tau_f * b.area).epsilon(exact));
  CHECK(slid[2].broken == Broken::shear);
  CHECK(norm(slid[2].shear_force) == 0);
  CHECK(slid[2].normal_force == 0);  // the tension of a bond that breaks in shear is lost
}

TEST_CASE(
    "reference/shear: softening meets the Coulomb line under constant pressure [section 4, rel 1e-12]") {
  Parameters p;
  p.delta_s = 0.6;
  const Bond b = unit_bond(p);
  for (const double pressure : {0.0, 3e6, 15e6}) {
    const double N = pressure * b.area, S = p.tau_f * b.area + 0.9 * N, R = 0.25 * N, u_l = S / b.k_s;
    const double u = -N / b.k_n;
    // out, unload to a third, on past failure, back through zero to sliding the other way
    const double y1 = 1.2 * u_l, y2 = 2 * u_l;
    auto path = along({{u, 0}, {u, y1}, {u, y1 / 3}, {u, y2}, {u, -y1}}, 101);
    const auto bonds = bond_path(p, b, path);
    double top = 0, friction = 0, y = 0;
    bool slipping = false;
    const double err = deviation(path, bonds, S, shear_y, [&](PathPoint q) {
      const double dy = q.y - y;
      y = q.y;
      if (!slipping) {
        const double F = softened(b.k_s, u_l, 0.6, q.y, top);
        const bool on_branch = q.y >= top && q.y > u_l;
        slipping = on_branch && F <= R;
        friction = slipping ? R : F;
      } else {
        friction = std::clamp(friction + b.k_s * dy, -R, R);
      }
      return friction;
    });
    CHECK(err < exact);
    CHECK(bonds.back().broken == Broken::shear);
    CHECK(bonds.back().shear_force.y == doctest::Approx(-R).epsilon(exact));
    CHECK(bonds.back().normal_force == doctest::Approx(-N).epsilon(exact));
    // no jump where the branches meet, beyond the slope times the step
    for (std::size_t k = 1; k < path.size(); ++k) {
      const double change = std::abs(bonds[k].shear_force.y - bonds[k - 1].shear_force.y);
      CHECK(change <=
            (1 + 1e-9) * std::max(1.0, 1 / 0.6) * b.k_s * std::abs(path[k].y - path[k - 1].y) + 1e-9 * S);
    }
  }
}

TEST_CASE(
    "reference/shear: a stronger pressure reloads with the secant stiffness to (1 - D) S [section 4, rel "
    "1e-12]") {
  Parameters p;
  p.delta_s = 1.0;
  p.mu2 = 0;
  const Bond b = unit_bond(p);
  const double S0 = p.tau_f * b.area, S1 = 1.5 * S0;
  const double u = -(S1 - S0) / 0.9 / b.k_n;
  REQUIRE(-u * b.k_n / b.area < p.LCS[0]);
  const double y1 = 1.5 * S0 / b.k_s;  // D = 1/2, F = S0/2
  const double reached = S1 / b.k_s * 1.5;
  const std::vector<PathPoint> path{
      {0, y1}, {u, y1}, {u, 0.999 * reached}, {u, reached}, {u, 0.8 * 2 * S1 / b.k_s}};
  const auto bonds = bond_path(p, b, path);
  CHECK(bonds[0].shear_force.y == doctest::Approx(0.5 * S0).epsilon(exact));
  CHECK(bonds[1].shear_force.y == doctest::Approx(0.5 * S0).epsilon(exact));
  CHECK(bonds[2].shear_force.y == doctest::Approx(0.5 * S1 * 0.999).epsilon(exact));
  CHECK(bonds[3].shear_force.y == doctest::Approx(0.5 * S1).epsilon(exact));
  CHECK(bonds[2].D_s == doctest::Approx(0.5).epsilon(exact));
  CHECK(bonds[4].shear_force.y == doctest::Approx(0.4 * S1).epsilon(exact));  // D = 0.6 at 1.6 u_l
  // and a weaker one lets the bond soften at once: D = (u/u_l - 1)/delta with the smaller u_l
  const auto eased = bond_path(p, b, std::vector<PathPoint>{{u, 1.2 * S1 / b.k_s}, {0, 1.2 * S1 / b.k_s}});
  CHECK(eased[0].shear_force.y == doctest::Approx(0.8 * S1).epsilon(exact));
  CHECK(eased[1].shear_force.y == doctest::Approx(0.2 * S0).epsilon(exact));
}

TEST_CASE(
    "reference/shear: friction in two directions is a radial return, open bonds have none [section 4, rel "
    "1e-12]") {
  const Parameters p;
  Bond b = unit_bond(p);
  b.broken = Broken::tension;
  b.D_n = 1;
  const double u = -10e6 * b.area / b.k_n, R = 0.25 * 10e6 * b.area, y = 3 * R / b.k_s;
  const std::vector<PathPoint> path{{u, 0, 0},  {u, y, 0}, {u, y, 0.75 * R / b.k_s},
                                    {-u, y, y}, {u, y, y}, {u, y, y + 0.5 * R / b.k_s}};
  const auto bonds = bond_path(p, b, path);
  CHECK(bonds[0].shear_force == Vec3{});
  CHECK(bonds[1].shear_force.y == doctest::Approx(R).epsilon(exact));
  CHECK(bonds[2].shear_force.y ==
        doctest::Approx(0.8 * R).epsilon(exact));  // (1, 0.75) scaled back to length 1
  CHECK(bonds[2].shear_force.z == doctest::Approx(0.6 * R).epsilon(exact));
  CHECK(norm(bonds[3].shear_force) == 0);
  CHECK(bonds[3].normal_force == 0);
  CHECK(norm(bonds[4].shear_force) == 0);  // closed again: friction starts from zero
  CHECK(bonds[5].shear_force.z == doctest::Approx(0.5 * R).epsilon(exact));
}

TEST_CASE(
    "reference/law: uncoupled, tension and shear know nothing of each other until one breaks [section 4]") {
  Parameters p;
  const Bond b = unit_bond(p);
  const double u_l = stretch_limit(p, b), s_l = shear_limit(p, b);
  const auto bonds =
      bond_path(p, b,
                std::vector<PathPoint>{
                    {1.1 * u_l, 0}, {1.1 * u_l, s_l}, {1.1 * u_l, 1.1 * s_l}, {1.3 * u_l, 1.1 * s_l}});
  CHECK(bonds[1].normal_force == doctest::Approx(0.5 * p.sigma_t * b.area).epsilon(exact));
  CHECK(bonds[1].shear_force.y == doctest::Approx(p.tau_f * b.area).epsilon(exact));
  CHECK(bonds[2].shear_force.y == doctest::Approx(0.5 * p.tau_f * b.area).epsilon(exact));
  CHECK(bonds[2].D_n == doctest::Approx(0.5).epsilon(exact));
  CHECK(bonds[3].broken == Broken::tension);
  CHECK(norm(bonds[3].shear_force) == 0);
  CHECK(bonds[3].D_s == doctest::Approx(0.5).epsilon(exact));
}

TEST_CASE("reference/coupled: radial path, one damage, linear softening of both [section 4, rel 1e-12]") {
  Parameters p;
  p.criterion = Criterion::coupled;
  p.delta_n = 0.3;
  p.delta_s = 0.9;
  const Bond b = unit_bond(p);
  const double u_l = stretch_limit(p, b), s_l = shear_limit(p, b);
  for (const double share : {0.2, 0.45, 0.75}) {  // of tension in r
    const double delta = 0.3 * share + 0.9 * (1 - share);
    const double tip = 1 + 0.5 * delta;
    const auto at = [&](double r) { return PathPoint{r * share * u_l, r * (1 - share) * s_l, 0}; };
    const auto path = along({at(tip), at(0.2), at(1 + 0.99 * delta), at(1 + 1.01 * delta)}, 89);
    const auto bonds = bond_path(p, b, path);
    double top_n = 0, top_s = 0;
    CHECK(deviation(path, bonds, p.sigma_t * b.area, normal, [&](PathPoint q) {
            return share * softened(p.sigma_t * b.area, 1, delta, q.u / u_l / share, top_n);
          }) < exact);
    CHECK(deviation(path, bonds, p.tau_f * b.area, shear_y, [&](PathPoint q) {
            return (1 - share) * softened(p.tau_f * b.area, 1, delta, q.y / s_l / (1 - share), top_s);
          }) < exact);
    CHECK(bonds.back().broken == (share > 0.5 ? Broken::tension : Broken::shear));
  }
}

TEST_CASE(
    "reference/coupled: opening alone leaves the shear displacement alone, with two deltas [section 4, rel "
    "1e-12]") {
  Parameters p;
  p.criterion = Criterion::coupled;
  p.delta_n = 0.3;
  p.delta_s = 0.9;
  const Bond b = unit_bond(p);
  const double u_l = stretch_limit(p, b), s_l = shear_limit(p, b);
  // shear to D = 1/2 in compression, open, close, open further, and back
  const double y = 1.45 * s_l;
  const std::vector<PathPoint> path{{0, y},    {0.1 * u_l, y}, {0.02 * u_l, y},
                                    {-u_l, y}, {0, 0.5 * y},   {0.05 * u_l, 0.5 * y}};
  const auto bonds = bond_path(p, b, path);
  CHECK(bonds[0].D_n == doctest::Approx(0.5).epsilon(exact));
  CHECK(bonds[0].shear_force.y == doctest::Approx(0.5 * p.tau_f * b.area).epsilon(exact));
  for (const Bond& q : {bonds[0], bonds[1], bonds[2]})
    CHECK(q.F_s.y == doctest::Approx(b.k_s * y).epsilon(exact));
  const double r = 1.55, delta = (0.3 * 0.1 + 0.9 * 1.45) / r, D = (r - 1) / delta;
  CHECK(bonds[1].D_s == doctest::Approx(D).epsilon(exact));
  CHECK(bonds[1].shear_force.y == doctest::Approx((1 - D) * 1.45 / r * p.tau_f * b.area).epsilon(exact));
  CHECK(bonds[1].normal_force == doctest::Approx((1 - D) * 0.1 / r * p.sigma_t * b.area).epsilon(exact));
  const double mixed = (0.3 * 0.02 + 0.9 * 1.45) / 1.47;  // D kept, the mixture follows the direction
  CHECK(bonds[2].D_s == doctest::Approx(D).epsilon(exact));
  CHECK(bonds[2].shear_force.y == doctest::Approx((1 - D) / (1 + mixed * D) * b.k_s * y).epsilon(exact));
  CHECK(bonds[3].normal_force ==
        doctest::Approx(-b.k_n * u_l).epsilon(exact));  // closed: full k_n, (1 - D) in shear
  CHECK(bonds[3].shear_force.y == doctest::Approx((1 - D) / (1 + 0.9 * D) * b.k_s * y).epsilon(exact));
  CHECK(bonds[4].shear_force.y == doctest::Approx(0.5 * (1 - D) / (1 + 0.9 * D) * b.k_s * y).epsilon(exact));
  CHECK(bonds.back().broken == Broken::no);
}

TEST_CASE(
    "reference/mohr-coulomb: tension lowers the shear strength, pressure raises it [section 4, rel 1e-12]") {
  Parameters p;
  p.criterion = Criterion::mohr_coulomb;
  p.delta_s = 0.5;
  p.mu1 = 2.5;
  const Bond b = unit_bond(p);
  for (const double stress : {-8e6, 0.0, 4e6}) {
    const double u = stress * b.area / b.k_n, S = (16e6 - 2.5 * stress) * b.area,
                 R = 0.25 * std::max(-stress, 0.0) * b.area;
    const auto path = along({{u, 0}, {u, 2 * S / b.k_s}}, 93);
    const auto bonds = bond_path(p, b, path);
    double top = 0;
    CHECK(deviation(path, bonds, S, shear_y, [&](PathPoint q) {
            const double F = softened(b.k_s, S / b.k_s, 0.5, q.y, top);
            return q.y * b.k_s > S ? std::max(R, F) : F;
          }) < exact);
    CHECK(bonds.back().broken == Broken::shear);
  }
  p.mu1 = 4;  // S = 0 before sigma_t is reached: nothing breaks without shear, the least shear breaks it
  const double u = 4.5e6 * b.area / b.k_n;
  const auto bonds = bond_path(p, b, std::vector<PathPoint>{{u, 0}, {u, 1e-12}});
  CHECK(bonds[0].broken == Broken::no);
  CHECK(bonds[1].broken == Broken::shear);
  CHECK(bond_path(p, b, std::vector<PathPoint>{{1.3 * stretch_limit(p, b)}}).back().broken ==
        Broken::tension);
}

TEST_CASE("reference/energy: one bond dissipates the area under its branch, O(du^2) [section 3 and 4]") {
  Parameters p;
  p.delta_n = 0.7;
  p.delta_s = 0.4;
  const Bond b = unit_bond(p);
  const double u_l = stretch_limit(p, b), s_l = shear_limit(p, b);
  for (const int steps : {37, 101, 1009, 10007}) {
    // a kink between two slopes inside a step is worth at most |change of slope| du^2/8
    const auto pull = along({{2 * u_l}}, steps), slide = along({{0, 2 * s_l}}, steps);
    const double du = 2 * u_l / steps, dy = 2 * s_l / steps;
    const double W_n = work(pull, bond_path(p, b, pull)), W_s = work(slide, bond_path(p, b, slide));
    CHECK(std::abs(W_n - 0.5 * p.sigma_t * b.area * u_l * 1.7) < b.k_n * (1 + 2 / 0.7) * du * du / 8);
    CHECK(std::abs(W_s - 0.5 * p.tau_f * b.area * s_l * 1.4) < b.k_s * (1 + 2 / 0.4) * dy * dy / 8);

    // under pressure: between branch and Coulomb line damage, on the line friction
    const double N = 10e6 * b.area, S = p.tau_f * b.area + 0.9 * N, R = 0.25 * N, y_l = S / b.k_s,
                 y_end = 2 * y_l;
    auto path = along({{-N / b.k_n, 0}, {-N / b.k_n, y_end}}, steps);
    path.erase(path.begin(), path.begin() + steps - 1);  // first point: pressed
    const double W = work(path, bond_path(p, b, path)) - 0.5 * N * N / b.k_n;
    const double y_r = y_l * (1 + 0.4 * (1 - R / S));  // where they meet
    const double want = 0.5 * S * y_l + 0.5 * (S + R) * (y_r - y_l) + R * (y_end - y_r), h = y_end / steps;
    CHECK(std::abs(W - want) < b.k_s * (1 + 2 / 0.4) * h * h / 8);
  }
  p.G_I = 60;  // and with a fracture energy the area under the branch is that energy
  const Bond tough = unit_bond(p);
  REQUIRE(tough.delta_n > 1);
  const double end = stretch_limit(p, tough) * (1 + tough.delta_n);
  const auto pull = along({{1.01 * end}}, 200000);
  CHECK(work(pull, bond_path(p, tough, pull)) / tough.area == doctest::Approx(60).epsilon(1e-6));
}

TEST_CASE(
    "reference/energy: no step of yielding gives back more than was stored, whatever its slip [(B107)]") {
  std::mt19937 random(107);
  std::uniform_real_distribution<double> in(-1.0, 1.0), unit(0.0, 1.0);
  Parameters p;
  p.breakage = false;
  const Bond b = unit_bond(p);
  const double deep = 0.02 * b.d0;
  const auto stored = [&](const Bond& c, double u) {
    return 0.5 * b.k_n * (u - c.u_p) * (u - c.u_p) + 0.5 * dot(c.F_s, c.F_s) / b.k_s;
  };
  double least = 1.0;
  int taken_back = 0;
  for (int loop = 0; loop < 300; ++loop) {
    std::vector<PathPoint> corners;
    const double across = deep * std::pow(10.0, 1.0 - 2.0 * unit(random));
    for (int k = 0; k < 6; ++k)
      corners.push_back({-deep * unit(random), across * in(random), across * in(random)});
    const auto path = along(corners, 2000);
    const auto bonds = bond_path(p, b, path);
    PathPoint a;
    Bond f = b;
    for (std::size_t k = 0; k < path.size(); a = path[k], f = bonds[k], ++k) {
      const Vec3 slip{0, path[k].y - a.y, path[k].z - a.z};
      const Vec3 shear = 0.5 * (f.F_s + bonds[k].F_s);
      const double work =
          0.5 * (f.normal_force + bonds[k].normal_force) * (path[k].u - a.u) + dot(shear, slip);
      const double lost = work - (stored(bonds[k], path[k].u) - stored(f, a.u));
      least = std::min(least, lost / (p.LCS[0] * b.area * deep));
      taken_back += bonds[k].u_p < f.u_p && dot(f.F_s, slip) < 0;
    }
  }
  CHECK(least > -1e-9);
  CHECK(taken_back > 10000);
}

TEST_CASE("reference/toggles: no breakage and no plasticity is a spring [rel 1e-12]") {
  Parameters p;
  p.breakage = p.plasticity = false;
  const Bond b = unit_bond(p);
  const double far = 0.1 * b.d0;
  const auto path = along({{far, far}, {-far, -far, far}}, 10);
  const auto bonds = bond_path(p, b, path);
  CHECK(deviation(path, bonds, b.k_n * far, normal, [&](PathPoint q) { return b.k_n * q.u; }) < exact);
  CHECK(deviation(path, bonds, b.k_n * far, shear_y, [&](PathPoint q) { return b.k_s * q.y; }) < exact);
}

TEST_CASE("reference/pair: a driven pair of spheres follows the law's path [section 4, rel 1e-10]") {
  for (const Criterion criterion : {Criterion::uncoupled, Criterion::coupled, Criterion::mohr_coulomb}) {
    Parameters p;
    p.criterion = criterion;
    p.contact_damping = false;
    p.delta_n = 0.5;
    std::vector<Particle> two{sphere(p, 1, 0.01, {}), sphere(p, 2, 0.015, {0.025, 0, 0})};
    Bond b = make_bond(p, two, 0, 1);
    const double u_l = stretch_limit(p, b), s_l = shear_limit(p, b);
    const auto path = along(
        {{-6 * u_l, 0.5 * s_l, 0.1 * s_l}, {0.5 * u_l, 0.3 * s_l}, {1.1 * u_l, -0.3 * s_l}, {-u_l, s_l, s_l}},
        40);
    const auto bonds = bond_path(p, b, path);
    double worst = 0;
    PathPoint from;
    for (std::size_t k = 0; k < path.size(); from = path[k], ++k) {
      place_pair(b, from, path[k], 1e-7, two[0], two[1]);
      for (Particle& a : two) a.force = a.torque = {};
      update_bond(p, b, two[0], two[1], 1e-7);
      const Vec3 want = Vec3{bonds[k].normal_force, 0, 0} + bonds[k].shear_force;
      const double d = b.d0 + path[k].u;
      const Vec3 torque = d * cross(Vec3{1, 0, 0}, bonds[k].shear_force);
      worst = std::max({worst, norm(two[0].force - want) / (p.sigma_t * b.area),
                        norm(two[1].force + want) / (p.sigma_t * b.area),
                        norm(two[0].torque + two[1].torque - torque) / (p.sigma_t * b.area * d)});
    }
    CHECK(worst < 1e-10);
    CHECK(b.broken == bonds.back().broken);
    CHECK(two[0].torque.z ==
          doctest::Approx(0.4 * (two[0].torque.z + two[1].torque.z)).epsilon(1e-10));  // arms as radii
  }
}

TEST_CASE("reference/pair: the shear force turns with the pair and keeps its length [section 4]") {
  // A rigid turn of 1 radian in 1000 steps: exact positions, mean velocities and spins. About an
  // oblique axis k_s = 0, to see the turning alone: velocities at n - 1/2 on the normal at n give
  // du = d dt^2/2 (w.n) w_t a step there.
  for (const bool oblique : {true, false}) {
    Parameters p;
    p.contact_damping = false;
    if (oblique) p.kappa = 0;
    std::vector<Particle> two{sphere(p, 1, 0.01, {}), sphere(p, 2, 0.01, {0.02, 0, 0})};
    Bond b = make_bond(p, two, 0, 1);
    b.F_s = {0, 300, 400};
    const int steps = 1000;
    const Vec3 axis = oblique ? Vec3{1 / 3.0, 2 / 3.0, 2 / 3.0} : Vec3{0, 0.6, 0.8};
    const auto turned = [&](const Vec3& a, double t) {  // Rodrigues
      return std::cos(t) * a + std::sin(t) * cross(axis, a) + ((1 - std::cos(t)) * dot(axis, a)) * axis;
    };
    for (int k = 1; k <= steps; ++k) {
      const Vec3 now = turned({0.02, 0, 0}, double(k) / steps);
      two[1].v = double(steps) * (now - two[1].x);
      two[1].x = now;
      two[0].w = two[1].w = axis;
      update_bond(p, b, two[0], two[1], 1.0 / steps);
    }
    const double made = oblique ? 0 : b.k_s * 0.02 / 6 / steps / steps;  // arc less chord
    CHECK(norm(b.F_s - turned({0, 300, 400}, 1.0)) < 1.01 * made + 1e-6 * 500);
    CHECK(std::abs(dot(b.F_s, two[1].x)) < 1e-12);
    if (oblique) CHECK(norm(b.F_s) == doctest::Approx(500).epsilon(1e-12));
  }
}

TEST_CASE("reference/damping: contact damping of a bond, intact, damaged, broken [section 2, rel 1e-12]") {
  Parameters p;
  const std::vector<Particle> two{sphere(p, 1, 0.01, {}), sphere(p, 2, 0.01, {0.02, 0, 0})};
  const Bond fresh = make_bond(p, two, 0, 1);
  const double u_l = stretch_limit(p, fresh), v = 3;
  const auto total = [&](Bond b, double u, double speed) {
    std::vector<Particle> pair = two;
    pair[1].x.x += u;
    pair[1].v.x = speed;
    update_bond(p, b, pair[0], pair[1], 1e-9);
    CHECK(pair[0].force.x == b.normal_total);
    CHECK(pair[1].force.x == -b.normal_total);
    return b.normal_total - b.normal_force;
  };
  CHECK(total(fresh, 0, v) == doctest::Approx(fresh.c_n * v).epsilon(1e-9));
  CHECK(total(fresh, -u_l, v) == doctest::Approx(fresh.c_n * v).epsilon(1e-9));
  CHECK(total(fresh, 1.1 * u_l, -v) ==
        doctest::Approx(-fresh.c_n * v * 0.5 / 1.1).epsilon(1e-9));  // g(1/2) = 0.5/1.1
  Bond broken = fresh;
  broken.broken = Broken::tension;
  CHECK(total(broken, u_l, v) == 0);
  CHECK(total(broken, -u_l, -v) == doctest::Approx(-fresh.c_n * v).epsilon(1e-9));
  CHECK(total(broken, -u_l, 1e6) == doctest::Approx(p.sigma_t * fresh.area).epsilon(1e-9));  // never pulls
  p.contact_damping = false;
  CHECK(total(fresh, -u_l, v) == 0);
}

TEST_CASE("reference/contact: restitution of the linear law [section 6, closed form, rel 2e-3]") {
  for (const double xi : {0.1, 0.5, 0.9}) {
    World world;
    world.parameters.xi = xi;
    const Parameters& p = world.parameters;
    world.particles = {sphere(p, 1, 0.01, {}, 0), sphere(p, 2, 0.02, {0.0301, 0, 0}, 0)};
    world.particles[1].v.x = -0.5;
    make_bonds(world);
    CHECK(world.bonds.empty());
    for (int k = 0; k < 400000; ++k) step(world, 1e-9);
    const double phi = std::asin(xi), e = std::exp(-(std::numbers::pi - 2 * phi) * std::tan(phi));
    CHECK((world.particles[1].v.x - world.particles[0].v.x) / 0.5 == doctest::Approx(e).epsilon(2e-3));
    CHECK(world.contacts.empty());
  }
}

TEST_CASE("reference/contact: sliding under weight is Coulomb with mu_2 [section 6, rel 1e-12]") {
  World world;
  const Parameters& p = world.parameters;
  world.particles = {sphere(p, 1, 0.01, {}, 0), sphere(p, 2, 0.01, {0.0199, 0, 0}, 0)};
  world.contacts[{0, 1}].free_length = 0.02;
  for (Particle& a : world.particles) a.held = {true, true, true};
  world.particles[0].w = {0, 0, 1};
  const double N = p.E * std::numbers::pi * 1e-4 / 0.02 * 1e-4,
               k_s = p.E * std::numbers::pi * 1e-4 / 0.02 / 2.4;
  double F = 0;
  for (int k = 0; k < 10; ++k) {
    world.particles[0].w = {0, 0, k < 7 ? 1.0 : -1.0};
    compute_forces(world, 1e-3);
    // surface of i moves by +a w along y: j lags behind, the force on i points back
    F = std::clamp(F - k_s * 0.00995 * world.particles[0].w.z * 1e-3, -0.25 * N, 0.25 * N);
    CHECK(world.particles[0].force.y == doctest::Approx(F).epsilon(1e-10));
    CHECK(world.particles[0].force.x == doctest::Approx(-N).epsilon(1e-10));
    CHECK(world.particles[0].torque.z == doctest::Approx(0.00995 * F).epsilon(1e-10));
  }
  CHECK(std::abs(F) < 0.25 * N);  // both sticking and sliding were met
}

TEST_CASE("reference/contact: the friction force turns with the pair [sections 4 and 6, rel 1e-12]") {
  World world;
  Parameters& p = world.parameters;
  p.kappa = 0;
  world.particles = {sphere(p, 1, 0.01, {}, 0), sphere(p, 2, 0.01, {0, 0, 0.019}, 0)};
  for (Particle& a : world.particles) a.w = {0, 0, 0.5};
  world.particles[1].v =
      (1 / 0.2) * (world.particles[1].x - 0.02 * Vec3{0.6, 0, 0.8});  // last normal (0.6, 0, 0.8)
  world.contacts[{0, 1}] = {0.02, {0.8, 3, -0.6}, 0, 0};
  compute_forces(world, 0.2);
  const Vec3 F = world.contacts.begin()->second.F_s;  // (1, 3, 0) after the tilt, then 0.1 radian about z
  CHECK(F.x == doctest::Approx(std::cos(0.1) - 3 * std::sin(0.1)).epsilon(exact));
  CHECK(F.y == doctest::Approx(std::sin(0.1) + 3 * std::cos(0.1)).epsilon(exact));
  CHECK(std::abs(F.z) < exact);
}

TEST_CASE("reference/step: external force, held components, global damping [sections 1 and 7, rel 1e-14]") {
  World world;
  Parameters& p = world.parameters;
  p.damping_translation = 0.1;
  p.damping_rotation = 0.2;
  world.particles = {sphere(p, 1, 0.1, {}), sphere(p, 2, 0.1, {1, 0, 0})};
  Particle& a = world.particles[0];
  Particle& b = world.particles[1];
  a.external_force = {5, 0, 0};
  a.external_torque = {0, 0, 2};
  a.v = {0, 3, 4};
  a.w = {0, 0, -1};
  b.external_force = {100, 5, 0};
  b.v = {7, 0, 2};
  b.held = {true, false, false};
  const double m = a.mass, I = a.inertia;
  step(world, 1e-3);
  CHECK(a.v.x == doctest::Approx(5e-3 / m).epsilon(1e-14));
  CHECK(a.v.y == doctest::Approx(3 - 1e-3 * 0.5 * 0.6 / m).epsilon(1e-14));
  CHECK(a.v.z == doctest::Approx(4 - 1e-3 * 0.5 * 0.8 / m).epsilon(1e-14));
  CHECK(a.w.z == doctest::Approx(-1 + 1e-3 * 2.4 / I).epsilon(1e-14));
  CHECK(a.x.y == doctest::Approx(1e-3 * a.v.y).epsilon(1e-14));
  CHECK(a.force == Vec3{5, 0, 0});  // reported without global damping
  CHECK(b.v.x == 7);
  CHECK(b.x.x == doctest::Approx(1.007).epsilon(1e-14));
  CHECK(b.v.y == doctest::Approx(5e-3 / m).epsilon(1e-14));  // damping sees free components alone
  CHECK(b.v.z == doctest::Approx(2 - 1e-3 * 0.5 / m).epsilon(1e-14));
}

TEST_CASE("reference/cluster: momentum and angular momentum of a breaking cluster, to round-off") {
  for (const Criterion criterion : {Criterion::uncoupled, Criterion::coupled, Criterion::mohr_coulomb}) {
    World world;
    Parameters& p = world.parameters;
    p.E = 1e9;
    p.LCS = {5e6, 8e6, 10e6};
    p.sigma_t = 2e6;
    p.tau_f = 4e6;
    p.xi = 0.2;
    p.criterion = criterion;
    std::mt19937 random(20240601);
    std::uniform_real_distribution<double> in(-1, 1);
    const auto noise = [&](double size) { return size * Vec3{in(random), in(random), in(random)}; };
    for (int x = 0; x < 4; ++x)
      for (int y = 0; y < 3; ++y)
        for (int z = 0; z < 3; ++z) {
          const Vec3 at{0.1 * x, 0.1 * y, 0.1 * z};
          Particle a = sphere(p, 40 - std::int64_t(world.particles.size()), 0.05 + 0.005 * in(random),
                              at + noise(0.004), x < 3 ? 1 : 2);
          a.v = noise(6) + (x < 2 ? Vec3{4, 0, 0} : Vec3{-4, 0, 0});
          a.w = noise(60);
          world.particles.push_back(a);
        }
    make_bonds(world);
    REQUIRE(world.bonds.size() > 50);
    double mass_times_speed = 0;
    for (const Particle& a : world.particles) mass_times_speed += a.mass * norm(a.v);
    const auto momenta = [&] {
      Vec3 P, L;
      for (const Particle& a : world.particles) {
        P += a.mass * a.v;
        L += a.mass * cross(a.x, a.v) + a.inertia * a.w;
      }
      return std::pair{P, L};
    };
    const auto [P0, L0] = momenta();
    std::size_t touching = 0, plastic = 0;
    for (int k = 0; k < 1500; ++k) {
      step(world, 2e-6);
      touching = std::max(touching, world.contacts.size());
    }
    const auto [P, L] = momenta();
    CHECK(norm(P - P0) < 1e-13 * mass_times_speed);
    CHECK(norm(L - L0) < 1e-13 * mass_times_speed * 0.5);
    const auto count = [&](Broken mode) { return std::ranges::count(world.bonds, mode, &Bond::broken); };
    for (const Bond& b : world.bonds) plastic += b.u_p < 0;
    CHECK(count(Broken::tension) > 0);
    CHECK(count(Broken::shear) > 0);
    CHECK(touching > 0);
    CHECK(plastic > 0);
  }
}

TEST_CASE("reference/kratos: two spheres pulled apart [Kratos benchmark 22, rel 1e-5]") {
  const std::filesystem::path file =
      std::filesystem::path(BRECCIA_SOURCE_DIR "/../shared/reference") / "reference_graph_benchmark22.dat";
  if (!std::filesystem::exists(file)) {
    MESSAGE("skipped 'reference_graph_benchmark22.dat is not here'");
    return;
  }
  World world;
  Parameters& p = world.parameters;
  p.E = 1e9;
  p.sigma_t = 1e6;
  p.tau_f = 0.5e6;
  p.delta_n = 0.8;
  p.plasticity = p.contact_damping = false;
  world.particles = {sphere(p, 140, 1, {-1, 0, 0}), sphere(p, 141, 1, {1, 0, 0})};
  for (Particle& a : world.particles) a.held = {true, true, true};
  world.particles[1].v.x = 0.1;
  make_bonds(world);
  std::ifstream in(file);
  double time = 0, fx = 0, fy = 0, worst = 0, peak = 0, peak_time = 0;
  int rows = 0;
  while (in >> time >> fx >> fy) {
    step(world, 1e-5);
    const double force = world.particles[1].force.x;  // on the moving sphere: back towards the other
    worst = std::max(worst, std::abs(force - fx) / 3.14159e6);
    if (-force > peak) peak = -force, peak_time = time;
    ++rows;
  }
  CHECK(rows == 5000);
  CHECK(worst < 1e-5);
  CHECK(peak == doctest::Approx(3.14159e6).epsilon(1e-5));
  CHECK(peak_time == doctest::Approx(0.02).epsilon(1e-3));
  CHECK(world.bonds[0].broken == Broken::tension);
}
