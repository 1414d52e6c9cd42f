// The law of a bond as the production loop runs it, one number at a time and in wide registers
// whose lanes carry different bonds: against closed forms of docs/model.md, and against the
// reference on random paths.
#include <doctest/doctest.h>

#include <random>

#include "core/world/energies.hpp"
#include "kernels/loops/bond_energy.hpp"
#include "tests/follow.hpp"
#include "tests/scene.hpp"

using namespace breccia;
namespace ref = breccia::reference;
namespace stdx = std::experimental;
using ref::Bond, ref::Broken, ref::Parameters, ref::PathPoint;
using scene::Outcome, scene::Path;

namespace {

constexpr double exact = 1e-12;

/// The constants of a bond as the production loop has them.
BondConstants<double> constants_of_bond(const Bond& b) { return {b.d0, b.area, b.area, b.k_n, b.c_n}; }

template <Features features, class R>
std::vector<std::vector<Outcome>> follow(const DempackLaw& law, const std::vector<Bond>& bonds,
                                         const std::vector<Path>& paths) {
  std::vector<BondConstants<double>> constants;
  for (const Bond& b : bonds) constants.push_back(constants_of_bond(b));
  return scene::follow<features, R>(law, constants, paths);
}

/// A path with the forces that the closed form gives along it.
struct Claim {
  std::string name;
  Bond bond;
  Path path;
  std::vector<Vec3> force;
  double scale;  ///< N
};

/// Runs all claims together, in every kind of register and with the claims in other lanes each
/// time.
template <Features features>
void hold(const Parameters& p, std::vector<Claim> claims) {
  const auto with = [&]<class R>(const std::string& name, R) {
    std::vector<Bond> bonds;
    std::vector<Path> paths;
    for (const Claim& c : claims) bonds.push_back(c.bond), paths.push_back(c.path);
    const auto got = follow<features, R>(scene::law(p), bonds, paths);
    for (std::size_t k = 0; k < claims.size(); ++k) {
      REQUIRE(claims[k].path.size() == claims[k].force.size());
      double worst = 0;
      for (std::size_t s = 0; s < claims[k].path.size(); ++s) {
        const double miss = norm(got[k][s].force - claims[k].force[s]) / claims[k].scale;
        worst = miss <= worst ? worst : miss;  // a NaN stays
      }
      INFO(claims[k].name, ", ", name);
      CHECK(worst < exact);
    }
  };
  for (std::size_t turn = 0; turn < claims.size(); turn += 3) {
    with("double", double{});
    with("native_simd", stdx::native_simd<double>{});
    with("8 lanes", stdx::fixed_size_simd<double, 8>{});
    std::rotate(claims.begin(), claims.begin() + 1, claims.end());
  }
}

constexpr Features features_of(Criterion criterion) { return {.criterion = criterion}; }

Bond bond_between(const Parameters& p, double r_i, double r_j, double d) {
  return ref::make_bond(p, {ref::sphere(p, 1, r_i, {}), ref::sphere(p, 2, r_j, {d, 0, 0})}, 0, 1);
}
/// Touching, apart, overlapping, nested: lanes with different areas and lengths.
std::vector<Bond> several_bonds(const Parameters& p) {
  return {bond_between(p, 0.01, 0.01, 0.02), bond_between(p, 0.01, 0.02, 0.0325),
          bond_between(p, 0.03, 0.008, 0.035), bond_between(p, 0.02, 0.005, 0.0035)};
}
double stretch_limit(const Parameters& p, const Bond& b) { return p.sigma_t * b.area / b.k_n; }
double shear_limit(const Parameters& p, const Bond& b) { return p.tau_f * b.area / b.k_s; }
double length_of(const Parameters& p, const Bond& b) { return p.E * b.area / b.k_n; }

Path along(const Path& corners, int steps) {
  Path path;
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

/// Stretches as the difference of a distance and d0 can be: the law is not blamed for the rounding
/// of the distance.
Path representable(const Bond& b, Path path) {
  for (PathPoint& q : path) q.u = (b.d0 + q.u) - b.d0;
  return path;
}

template <class Force>
Claim claim(const char* name, const Bond& bond, const Path& any_path, double scale, Force force) {
  const Path path = representable(bond, any_path);
  Claim c{name, bond, path, {}, scale};
  for (const PathPoint& q : path) c.force.push_back(force(q));
  return c;
}

/// Stress of the envelope at strain e, drawn from corner to corner.
double three_slopes(const Parameters& p, double e) {
  double from = 0, reached = 0, slope = p.E;
  for (int k = 0; k < 3; ++k) {
    const double to = from + (p.LCS[k] - reached) / slope;
    if (e < to) return reached + slope * (e - from);
    from = to, reached = p.LCS[k], slope = p.E / p.YRC[k];
  }
  return reached + slope * (e - from);
}

/// Linear softening with secant unloading; `top` is the largest displacement so far.
double softened(double k, double limit, double delta, double x, double& top) {
  top = std::max(top, x);
  if (top <= limit) return k * x;
  const double end = limit * (1 + delta);
  return top >= end ? 0.0 : k * limit * (end - top) / (end - limit) * (x / top);
}

void add_compression(const Parameters& p, std::vector<Claim>& claims) {
  for (const Bond& b : several_bonds(p)) {
    const double L = length_of(p, b);
    claims.push_back(claim("three slopes", b, along({{-0.06 * L}}, 300), p.LCS[2] * b.area, [&](PathPoint q) {
      return Vec3{-b.area * three_slopes(p, -q.u / L), 0, 0};
    }));
  }
  REQUIRE(three_slopes(p, 0.06) > p.LCS[2]);
}

/// Slip while the compression yields: k_s/YRC of the branch, k_s before and when unloaded.
void add_shear_under_yield(const Parameters& p, std::vector<Claim>& claims) {
  for (const Bond& b : several_bonds(p)) {
    const double L = length_of(p, b), first = p.LCS[0] / p.E,
                 second = first + (p.LCS[1] - p.LCS[0]) * p.YRC[0] / p.E;
    const double u1 = -first * L, u2 = -0.9 * second * L, u3 = 0.95 * u2, y = 0.3 * (u1 - u2);
    const double left = p.shear_follows ? 1.0 / p.YRC[0] : 1.0;
    claims.push_back(claim("shear under yield", b, along({{u1, 0.1 * y}, {u2, 1.1 * y}, {u3, 1.2 * y}}, 60),
                           p.LCS[1] * b.area, [&, most = 0.0](PathPoint q) mutable {
                             most = std::min(most, q.u);
                             const double s = three_slopes(p, -most / L), back = q.u - most;
                             const double slip = q.y <= 0.1 * y   ? q.y
                                                 : q.y <= 1.1 * y ? 0.1 * y + left * (q.y - 0.1 * y)
                                                                  : 0.1 * y + left * y + (q.y - 1.1 * y);
                             return Vec3{-b.area * s + b.k_n * back, b.k_s * slip, 0};
                           }));
  }
}

/// Loading, unloading, reloading, through zero, softening in tension from the plastic stretch,
/// secant unloading.
void add_plastic_then_tension(const Parameters& p, std::vector<Claim>& claims) {
  for (const Bond& b : several_bonds(p)) {
    const double L = length_of(p, b), deep = -0.008 * L, u_l = stretch_limit(p, b);
    const double u_p = deep + b.area * three_slopes(p, 0.008) / b.k_n;
    REQUIRE(u_p < -10 * u_l);
    double deepest = 0, plastic = 0, top = 0;
    claims.push_back(
        claim("plastic, then tension", b,
              along({{deep},
                     {u_p},
                     {u_p + u_l},
                     {u_p + u_l * (1 + b.delta_n / 2)},
                     {u_p + 0.2 * u_l},
                     {u_p + u_l * (1 + 0.6 * b.delta_n)},
                     {deep},
                     {1.5 * deep},
                     {1.4 * deep}},
                    41),
              p.LCS[1] * b.area, [&](PathPoint q) {
                if (q.u < deepest) {
                  deepest = q.u;
                  plastic = std::min(0.0, q.u + b.area * three_slopes(p, -q.u / L) / b.k_n);
                }
                const double u_e = q.u - plastic;
                return Vec3{u_e > 0 ? softened(b.k_n, u_l, b.delta_n, u_e, top) : b.k_n * u_e, 0, 0};
              }));
  }
}

/// Damage in tension, full stiffness when closed, the damage still there when opened again, then
/// broken for good.
void add_damage_compression_tension(const Parameters& p, std::vector<Claim>& claims) {
  for (const Bond& b : several_bonds(p)) {
    const double u_l = stretch_limit(p, b), d = b.delta_n;
    double top = 0;
    claims.push_back(claim("damage, compression, tension, broken", b,
                           along({{u_l * (1 + 0.3 * d)},
                                  {0.3 * u_l},
                                  {u_l * (1 + 0.5 * d)},
                                  {-u_l},
                                  {u_l * (1 + 0.55 * d)},
                                  {u_l * (1 + 1.2 * d)},
                                  {-u_l},
                                  {u_l}},
                                 53),
                           p.sigma_t * b.area, [&](PathPoint q) {
                             return Vec3{q.u > 0 ? softened(b.k_n, u_l, d, q.u, top) : b.k_n * q.u, 0, 0};
                           }));
  }
}

/// Shear under constant pressure: branch, secant unloading, the Coulomb line, sliding back the
/// other way.
void add_shear(const Parameters& p, std::vector<Claim>& claims) {
  const auto bonds = several_bonds(p);
  int k = 0;
  for (const double pressure : {0.0, 3e6, 15e6}) {
    const Bond& b = bonds[k++];
    const double N = pressure * b.area, S = p.tau_f * b.area + p.mu1 * N, R = p.mu2 * N, y_l = S / b.k_s,
                 u = -N / b.k_n, y1 = y_l * (1 + b.delta_s / 3);
    double top = 0, friction = 0, y = 0;
    bool sliding = false;
    // the shear starts under full pressure
    Path path = along({{u, 0}, {u, y1}, {u, y1 / 3}, {u, y_l * (1.5 + b.delta_s)}, {u, -y1}}, 71);
    path.erase(path.begin(), path.begin() + 70);
    claims.push_back(claim("shear into friction", b, path, S, [&](PathPoint q) {
      const double dy = q.y - y;
      y = q.y;
      if (sliding) {
        friction = std::clamp(friction + b.k_s * dy, -R, R);
      } else {
        const double F = softened(b.k_s, y_l, b.delta_s, q.y, top);
        sliding = q.y >= top && q.y > y_l && F <= R;
        friction = sliding ? R : F;
      }
      return Vec3{-N, friction, 0};
    }));
  }
}

/// Broken in tension, pressed again: friction in two directions from zero, none when open.
void add_broken_in_tension(const Parameters& p, std::vector<Claim>& claims) {
  const Bond b = several_bonds(p)[1];
  const double N = 10e6 * b.area, u = -N / b.k_n, R = p.mu2 * N, y = 3 * R / b.k_s,
               far = stretch_limit(p, b) * (1.01 + b.delta_n);
  claims.push_back(
      {"broken in tension, pressed again",
       b,
       {{far, 0, 0},
        {u, 0, 0},
        {u, y, 0},
        {u, y, 0.75 * R / b.k_s},
        {-u, y, y},
        {u, y, y},
        {u, y, y + 0.5 * R / b.k_s}},
       {{0, 0, 0}, {-N, 0, 0}, {-N, R, 0}, {-N, 0.8 * R, 0.6 * R}, {0, 0, 0}, {-N, 0, 0}, {-N, 0, 0.5 * R}},
       N});
  // shear that was there when the bond breaks in tension is lost in the same step
  const double s_l = shear_limit(p, b);
  claims.push_back({"shear of a bond that breaks in tension",
                    b,
                    {{0, 0.5 * s_l, 0}, {far, 0.5 * s_l, 0}, {u, 0.5 * s_l, 0}},
                    {{0, 0.5 * p.tau_f * b.area, 0}, {0, 0, 0}, {-N, 0, 0}},
                    N});
}

/// Broken in shear: the tension is lost, pressure comes back, no pull later.
void add_broken_in_shear(const Parameters& p, std::vector<Claim>& claims) {
  const Bond b = several_bonds(p)[2];
  const double N = 10e6 * b.area, u = -N / b.k_n, R = p.mu2 * N, s_l = shear_limit(p, b),
               u_t = 0.5 * stretch_limit(p, b), far = s_l * (1.01 + b.delta_s);
  claims.push_back(
      {"broken in shear",
       b,
       {{u_t, 0.5 * s_l, 0}, {u_t, far, 0}, {u_t, 0, 0}, {u, 0, 0}, {u, 0, 0.5 * R / b.k_s}, {u_t, 0, 0}},
       {{0.5 * p.sigma_t * b.area, 0.5 * p.tau_f * b.area, 0},
        {0, 0, 0},
        {0, 0, 0},
        {-N, 0, 0},
        {-N, 0, 0.5 * R},
        {0, 0, 0}},
       N});
}

Parameters tough() {
  Parameters p;
  p.delta_n = 0.8;
  p.delta_s = 0.6;
  return p;
}

constexpr Features uncoupled = features_of(Criterion::uncoupled), coupled = features_of(Criterion::coupled),
                   mohr_coulomb = features_of(Criterion::mohr_coulomb);

}  // namespace

TEST_CASE(
    "dempack/normal: slopes, unloading, through zero, softening, damage kept [(P53), closed form, 1e-12]") {
  const Parameters p = tough();
  std::vector<Claim> claims;
  add_compression(p, claims);
  add_plastic_then_tension(p, claims);
  add_damage_compression_tension(p, claims);
  hold<uncoupled>(p, claims);
  hold<mohr_coulomb>(p, claims);
}

TEST_CASE(
    "dempack/shear: k_s under yield falls with the normal tangent, or stays [(B107), closed form, 1e-12]") {
  for (const bool follows : {true, false}) {
    Parameters p = tough();
    p.shear_follows = follows;
    std::vector<Claim> claims;
    add_shear_under_yield(p, claims);
    hold<uncoupled>(p, claims);
  }
}

TEST_CASE(
    "dempack/shear: softening, Coulomb line, broken bonds and their friction [(P45), closed form, 1e-12]") {
  const Parameters p = tough();
  std::vector<Claim> claims;
  add_shear(p, claims);
  add_broken_in_tension(p, claims);
  add_broken_in_shear(p, claims);
  add_compression(p, claims);  // other lanes at work in other ways
  hold<uncoupled>(p, claims);
}

TEST_CASE(
    "dempack/shear: a stronger pressure reloads with the secant stiffness to (1 - D) S [(B21), 1e-12]") {
  Parameters p;
  p.delta_s = 1.0;
  p.mu2 = 0;
  std::vector<Claim> claims;
  for (const Bond& b : several_bonds(p)) {
    const double S0 = p.tau_f * b.area, S1 = 1.5 * S0, u = -(S1 - S0) / p.mu1 / b.k_n, N = b.k_n * -u;
    REQUIRE(N / b.area < p.LCS[0]);
    const double s0 = S0 / b.k_s, s1 = S1 / b.k_s;
    claims.push_back({"reloading",
                      b,
                      {{0, 1.5 * s0}, {u, 1.5 * s0}, {u, 0.999 * 1.5 * s1}, {u, 1.5 * s1}, {u, 1.6 * s1}},
                      {{0, 0.5 * S0, 0},
                       {-N, 0.5 * S0, 0},
                       {-N, 0.5 * S1 * 0.999, 0},
                       {-N, 0.5 * S1, 0},
                       {-N, 0.4 * S1, 0}},
                      S1});
    claims.push_back({"a weaker pressure softens at once",
                      b,
                      {{u, 1.2 * s1}, {0, 1.2 * s1}},
                      {{-N, 0.8 * S1, 0}, {0, 0.2 * S0, 0}},
                      S1});
  }
  hold<uncoupled>(p, claims);
}

TEST_CASE(
    "dempack/shear: a failing bond hands friction no more than it carried: |F| := min(|F|, R) [(B21), "
    "1e-12]") {
  Parameters p;
  p.delta_s = 1.0;
  p.mu1 = 0.1;
  p.mu2 = 2;
  std::vector<Claim> claims;
  for (const Bond& b : several_bonds(p)) {
    // D = 1/2, g = 1/3; then pressed with N = tau_f A and sheared on at once: S = 1.1, R = 2, trial
    // 1.8 g = 0.6
    const double S = p.tau_f * b.area, u = -S / b.k_n, y = S / b.k_s;
    claims.push_back({"handed over",
                      b,
                      {{0, 1.5 * y}, {u, 1.8 * y}, {u, 2.0 * y}, {u, 9.0 * y}},
                      {{0, 0.5 * S, 0}, {-S, 0.6 * S, 0}, {-S, 0.8 * S, 0}, {-S, 2 * S, 0}},
                      S});
  }
  hold<uncoupled>(p, claims);
}

TEST_CASE(
    "dempack/law: uncoupled, tension and shear know nothing of each other until one breaks [(P41), "
    "1e-12]") {
  const Parameters p;
  std::vector<Claim> claims;
  for (const Bond& b : several_bonds(p)) {
    const double u = stretch_limit(p, b), s = shear_limit(p, b), T = p.sigma_t * b.area, S = p.tau_f * b.area;
    claims.push_back({"independent",
                      b,
                      {{1.1 * u, 0}, {1.1 * u, s}, {1.1 * u, 1.1 * s}, {1.3 * u, 1.1 * s}},
                      {{0.5 * T, 0, 0}, {0.5 * T, S, 0}, {0.5 * T, 0.5 * S, 0}, {0, 0, 0}},
                      S});
  }
  hold<uncoupled>(p, claims);
}

TEST_CASE("dempack/law: delta = 0 breaks at once, in tension and in shear [(P49), 1e-12]") {
  Parameters p;
  p.delta_n = p.delta_s = 0;
  std::vector<Claim> claims;
  for (const Bond& b : several_bonds(p)) {
    const double u = stretch_limit(p, b), s = shear_limit(p, b), T = p.sigma_t * b.area, S = p.tau_f * b.area;
    claims.push_back({"brittle tension",
                      b,
                      {{0.5 * u}, {0.999 * u}, {1.001 * u}, {0.5 * u}, {-0.5 * u}},
                      {{0.5 * T, 0, 0}, {0.999 * T, 0, 0}, {0, 0, 0}, {0, 0, 0}, {-0.5 * T, 0, 0}},
                      T});
    claims.push_back({"brittle shear",
                      b,
                      {{0.5 * u, 0, 0}, {0.5 * u, 0, 0.999 * s}, {0.5 * u, 0, 1.001 * s}},
                      {{0.5 * T, 0, 0}, {0.5 * T, 0, 0.999 * S}, {0, 0, 0}},
                      S});
    claims.push_back({"brittle shear under pressure",
                      b,
                      {{-2 * u, 0.1 * s}, {-2 * u, 1.8 * s}},
                      {{-2 * T, 0.1 * S, 0}, {-2 * T, p.mu2 * 2 * T, 0}},
                      S});
  }
  hold<uncoupled>(p, claims);
}

TEST_CASE("dempack/law: delta from fracture energies, different in every bond [(B18), 1e-12]") {
  Parameters p;
  p.G_I = 25;
  p.G_II = 900;
  std::vector<Claim> claims;
  double least = 1e9, most = 0;
  for (const Bond& b : several_bonds(p)) {
    const double L = length_of(p, b), u_l = stretch_limit(p, b), s_l = shear_limit(p, b);
    const double delta_n = std::max(0.0, 2 * p.E * 25 / (p.sigma_t * p.sigma_t * L) - 1);
    const double delta_s = std::max(0.0, 2 * b.k_s * 900 / (p.tau_f * p.tau_f * b.area) - 1);
    least = std::min(least, delta_n), most = std::max(most, delta_n);
    double top = 0, top_s = 0;
    claims.push_back(claim("G_I", b,
                           along({{u_l * (1 + delta_n / 2)}, {0.1 * u_l}, {u_l * (1.2 + delta_n)}}, 61),
                           p.sigma_t * b.area, [&](PathPoint q) {
                             return Vec3{softened(b.k_n, u_l, delta_n, q.u, top), 0, 0};
                           }));
    claims.push_back(
        claim("G_II", b,
              along({{0, 0, s_l * (1 + delta_s / 2)}, {0, 0, 0.1 * s_l}, {0, 0, s_l * (1.2 + delta_s)}}, 61),
              p.tau_f * b.area, [&](PathPoint q) {
                return Vec3{0, 0, softened(b.k_s, s_l, delta_s, q.z, top_s)};
              }));
  }
  REQUIRE(most > 2 * least);
  hold<uncoupled>(p, claims);
}

TEST_CASE(
    "dempack/coupled: one damage for both forces of a pulled bond, kept when it closes [(B24), 1e-12]") {
  Parameters p;
  p.criterion = ref::Criterion::coupled;
  p.delta_n = 0.3;
  p.delta_s = 0.9;
  std::vector<Claim> claims;
  for (const Bond& b : several_bonds(p)) {
    const double u = stretch_limit(p, b), s = shear_limit(p, b), T = p.sigma_t * b.area, S = p.tau_f * b.area;
    for (const double share : {0.2, 0.75}) {  // of tension in r, on a radial path
      const double delta = 0.3 * share + 0.9 * (1 - share);
      const auto at = [&](double r) { return PathPoint{r * share * u}; };
      Path path = representable(
          b, along({at(1 + 0.5 * delta), at(0.2), at(1 + 0.99 * delta), at(1 + 1.01 * delta)}, 47));
      for (PathPoint& q : path) q.y = q.u / u / share * (1 - share) * s;
      double top = 0;
      claims.push_back(claim("radial", b, path, S, [&](PathPoint q) {
        const double F = softened(1, 1, delta, q.u / u / share, top);
        return Vec3{share * F * T, (1 - share) * F * S, 0};
      }));
    }
    // damaged by shear while closed (D = 1/2), opened, closed, sheared back
    const double y = 1.45 * s, D = (1.55 - 1) / ((0.3 * 0.1 + 0.9 * 1.45) / 1.55);
    const double mixed = (0.3 * 0.02 + 0.9 * 1.45) / 1.47, kept = (1 - D) / (1 + 0.9 * D);
    claims.push_back({"opening a sheared bond",
                      b,
                      {{0, y}, {0.1 * u, y}, {0.02 * u, y}, {-u, y}, {0, 0.5 * y}},
                      {{0, 0.5 * S, 0},
                       {(1 - D) * 0.1 / 1.55 * T, (1 - D) * 1.45 / 1.55 * S, 0},
                       {(1 - D) / (1 + mixed * D) * 0.02 * T, (1 - D) / (1 + mixed * D) * 1.45 * S, 0},
                       {-T, kept * 1.45 * S, 0},
                       {0, 0.5 * kept * 1.45 * S, 0}},
                      S});
  }
  add_compression(p, claims);
  add_shear(p, claims);
  hold<coupled>(p, claims);
}

TEST_CASE("dempack/mohr-coulomb: tension lowers the shear strength, pressure raises it [(B23), 1e-12]") {
  Parameters p;
  p.criterion = ref::Criterion::mohr_coulomb;
  p.delta_s = 0.5;
  p.mu1 = 2.5;
  std::vector<Claim> claims;
  for (const Bond& b : several_bonds(p))
    for (const double stress : {-8e6, 0.0, 4e6}) {
      const double u = representable(b, {{stress * b.area / b.k_n}})[0].u, N = b.k_n * u,
                   S = p.tau_f * b.area - 2.5 * N, R = p.mu2 * std::max(-N, 0.0);
      Path path = along({{u, 0}, {u, 1.9 * S / b.k_s}}, 93);
      path.erase(path.begin(), path.begin() + 92);
      double top = 0;
      bool broken = false;
      claims.push_back(claim("mohr-coulomb", b, path, S, [&](PathPoint q) {
        const double F = softened(b.k_s, S / b.k_s, 0.5, q.y, top);
        broken = broken || (q.y * b.k_s > S && F <= R);
        return Vec3{broken && N > 0 ? 0.0 : N, broken ? R : F, 0};
      }));
    }
  hold<mohr_coulomb>(p, claims);
  p.mu1 = 4;  // S = 0 before sigma_t is reached: nothing breaks without shear, the least shear breaks it
  claims.clear();
  for (const Bond& b : several_bonds(p)) {
    const double N = 4.5e6 * b.area, u = N / b.k_n;
    claims.push_back({"no strength left", b, {{u, 0}, {u, 1e-12}}, {{N, 0, 0}, {0, 0, 0}}, N});
  }
  hold<mohr_coulomb>(p, claims);
}

TEST_CASE("dempack/toggles: no breakage and no plasticity is a spring, either alone is kept [(P29), 1e-12]") {
  Parameters p = tough();
  p.shear_follows = false;
  std::vector<Claim> spring, plastic;
  for (const Bond& b : several_bonds(p)) {
    const double far = 0.02 * b.d0, L = length_of(p, b);
    spring.push_back(
        claim("spring", b, along({{far, far}, {-far, -far, far}}, 10), b.k_n * far, [&](PathPoint q) {
          return Vec3{b.k_n * q.u, b.k_s * q.y, b.k_s * q.z};
        }));
    plastic.push_back(claim("never broken", b, along({{-0.02 * L, far}}, 50), b.k_n * far, [&](PathPoint q) {
      return Vec3{-b.area * three_slopes(p, -q.u / L), b.k_s * q.y, 0};
    }));
  }
  constexpr Features none{.plasticity = false, .breakage = false}, no_breakage{.breakage = false},
      no_plasticity{.plasticity = false};
  hold<none>(p, spring);
  hold<no_breakage>(p, plastic);
  std::vector<Claim> elastic;
  for (const Bond& b : several_bonds(p))
    elastic.push_back(
        claim("never yields", b, along({{-0.05 * b.d0}}, 50), 0.05 * b.k_n * b.d0, [&](PathPoint q) {
          return Vec3{b.k_n * q.u, 0, 0};
        }));
  hold<no_plasticity>(p, elastic);
}

namespace {

/// Straight pieces between random corners that yield, damage, break, press again and slide.
Path random_path(const Parameters& p, const Bond& b, std::mt19937_64& random) {
  std::uniform_real_distribution<double> in(-1, 1), unit(0, 1);
  std::uniform_int_distribution<int> pieces(3, 9);
  const double u_l = stretch_limit(p, b), s_l = shear_limit(p, b), e = length_of(p, b);
  Path path;
  PathPoint from;
  const double violence = 0.3 + 1.7 * unit(random);
  const bool sheared = unit(random) < 0.4;  // little tension, so that shear is what breaks it
  while (path.size() < 400) {
    const double kind = unit(random);
    const double u = kind < 0.3   ? -0.03 * unit(random) * e * violence
                     : kind < 0.5 ? -3 * unit(random) * u_l
                     : sheared    ? 0.3 * in(random)*u_l
                                  : from.u + in(random)*u_l * violence;
    const double reach = (sheared ? 1.5 : 1.0) * violence * s_l;
    const PathPoint to{u, reach * in(random), reach * in(random)};
    const int steps = 8 * pieces(random);
    for (int k = 1; k <= steps; ++k) {
      const double t = double(k) / steps;
      path.push_back(
          {from.u + t * (to.u - from.u), from.y + t * (to.y - from.y), from.z + t * (to.z - from.z)});
    }
    from = to;
  }
  path.resize(400);
  return representable(b, path);
}

struct Met {
  int tension = 0, shear = 0, intact = 0, damaged = 0, plastic = 0, pressed_again = 0, sliding = 0;
};

template <Features features>
Met hold_random(Parameters p, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  p.criterion = static_cast<ref::Criterion>(features.criterion);
  p.plasticity = features.plasticity;
  p.breakage = features.breakage;
  std::vector<Bond> bonds;
  std::vector<Path> paths;
  for (int k = 0; k < 300; ++k) {
    const double r = 0.005 + 0.01 * unit(random), s = 0.005 + 0.01 * unit(random);
    bonds.push_back(bond_between(p, r, s, (r + s) * (0.7 + 0.4 * unit(random))));
    paths.push_back(random_path(p, bonds.back(), random));
  }
  std::vector<std::vector<Bond>> want;
  for (std::size_t k = 0; k < bonds.size(); ++k) want.push_back(ref::bond_path(p, bonds[k], paths[k]));
  Met met;
  for (const auto& path : want) {
    const Bond& last = path.back();
    met.tension += last.broken == Broken::tension;
    met.shear += last.broken == Broken::shear;
    met.intact += last.broken == Broken::no;
    met.damaged += std::ranges::any_of(
        path, [](const Bond& b) { return b.broken == Broken::no && (b.D_n > 0 || b.D_s > 0); });
    met.plastic += last.u_p < 0;
    met.pressed_again += last.broken == Broken::tension && std::ranges::any_of(path, [](const Bond& b) {
                           return b.broken == Broken::tension && b.normal_force < 0;
                         });
    met.sliding += last.broken != Broken::no && std::ranges::any_of(path, [](const Bond& b) {
                     return b.broken != Broken::no && norm(b.shear_force) > 0;
                   });
  }
  const auto with = [&]<class R>(const std::string& name, R) {
    const auto got = follow<features, R>(scene::law(p), bonds, paths);
    double force = 0, history = 0;
    for (std::size_t k = 0; k < bonds.size(); ++k)
      for (std::size_t s = 0; s < paths[k].size(); ++s) {
        const Bond& b = want[k][s];
        const Outcome& o = got[k][s];
        const double scale = std::max(p.LCS[0], p.tau_f) * b.area;
        const double miss = norm(o.force - Vec3{b.normal_force, b.shear_force.y, b.shear_force.z}) / scale;
        force = miss <= force ? force : miss;
        double far = std::max(norm(o.history.shear - b.F_s) / scale,
                              std::abs(o.history.plastic_stretch - b.u_p) / b.d0);
        if (features.breakage)
          far = std::max(
              {far, std::abs(o.history.damage_normal - b.D_n), std::abs(o.history.damage_shear - b.D_s)});
        history = far <= history ? history : far;
      }
    INFO(name);
    // the plastic part of a slip (B107) is a quotient of differences of lengths
    CHECK(force < (p.plasticity && p.shear_follows ? 1e-11 : exact));
    CHECK(history < 1e-11);
  };
  with("double", double{});
  with("native_simd", stdx::native_simd<double>{});
  with("8 lanes", stdx::fixed_size_simd<double, 8>{});
  return met;
}

}  // namespace

TEST_CASE(
    "dempack/random: 300 bonds along random paths of 400 steps as the reference [1e-12 of the strength; "
    "1e-11 where shear yields]") {
  for (const auto& [delta_n, delta_s] : {std::pair{0.2, 0.2}, {0.8, 1.5}, {0.0, 0.0}}) {
    Parameters p;
    p.delta_n = delta_n;
    p.delta_s = delta_s;
    for (const Met& met :
         {hold_random<uncoupled>(p, 11), hold_random<coupled>(p, 12), hold_random<mohr_coulomb>(p, 13)}) {
      CHECK(met.tension > 10);
      CHECK(met.shear > 10);
      CHECK(met.intact > 5);
      CHECK((met.damaged > 50 || delta_n == 0));
      CHECK(met.plastic > 50);
      CHECK(met.pressed_again > 5);
      CHECK(met.sliding > 20);
    }
  }
  Parameters elastic_shear;
  elastic_shear.shear_follows = false;
  hold_random<uncoupled>(elastic_shear, 11);
  hold_random<coupled>(elastic_shear, 12);
  for (const double onset : {0.0, 33e6}) {  // (B118)
    Parameters stiff_return;
    stiff_return.unloads = 1.7;
    stiff_return.yield_stress = onset;
    hold_random<Features{.unloading = true}>(stiff_return, 18);
    hold_random<Features{.criterion = Criterion::coupled, .unloading = true}>(stiff_return, 19);
  }
  Parameters tough_paths;
  tough_paths.G_I = 30;
  tough_paths.G_II = 1200;
  hold_random<uncoupled>(tough_paths, 14);
  hold_random<coupled>(tough_paths, 15);
  hold_random<Features{.plasticity = false}>(Parameters{}, 16);
  hold_random<Features{.plasticity = false, .breakage = false}>(Parameters{}, 17);
}

TEST_CASE(
    "dempack/failure strains: tension and shear have softened to nothing there [(P48), closed form, 1e-12]") {
  Material m = scene::material_of(Parameters{});
  m.failure_strain_normal = 4e-4, m.failure_strain_shear = 3e-3;
  const DempackLaw law = DempackLaw::of(m, 0.4);
  const Bond b = several_bonds(Parameters{})[1];
  BondConstants<double> c = constants_of_bond(b);
  const double L = strain_length(law.young, c), k_s = 0.4 * c.stiffness;
  const double u_l = 5e6 / 28e9 * L, s_l = 16e6 / (0.4 * 28e9) * L;
  const auto at = [&](double u, double y) {
    return scene::follow<uncoupled, double>(law, {c}, {{{u, y}}})[0].back();
  };
  for (const double part : {0.3, 0.7, 0.999}) {
    const double u = u_l + part * (4e-4 * L - u_l), y = s_l + part * (3e-3 * L - s_l);
    CHECK(at(u, 0).force.x == doctest::Approx(5e6 * c.area * (1 - part)).epsilon(1e-9));
    CHECK(at(0, y).force.y == doctest::Approx(16e6 * c.area * (1 - part)).epsilon(1e-9));
  }
  CHECK(at(1.0001 * 4e-4 * L, 0).history.damage_normal == 1);
  CHECK(at(0, 1.0001 * 3e-3 * L).history.damage_shear == 1);
  CHECK(k_s * s_l == doctest::Approx(16e6 * c.area).epsilon(1e-12));
}

TEST_CASE(
    "dempack/shear residual: to friction, or to nothing before friction begins anew [(P46), closed form, "
    "1e-9]") {
  for (const bool zero : {false, true}) {
    Parameters p;
    p.delta_s = 1.0;
    Material m = scene::material_of(p);
    m.softens_to_zero = zero;
    const DempackLaw law = DempackLaw::of(m, scene::shear_ratio(p));
    const Bond b = several_bonds(p)[0];
    const double N = 10e6 * b.area, u = -N / b.k_n, S = p.tau_f * b.area + p.mu1 * N, R = p.mu2 * N,
                 y_l = S / b.k_s;
    const auto path = along({{u, 0}, {u, 4 * y_l}}, 4000);
    const auto out = scene::follow<uncoupled, double>(law, {constants_of_bond(b)}, {path})[0];
    double least = S;
    for (std::size_t k = 4000; k < path.size(); ++k) {
      const double y = path[k].y, branch = y < y_l ? b.k_s * y : S * (2 - y / y_l);
      if (y > y_l) least = std::min(least, out[k].force.y);
      if (y < 2 * y_l - 1e-9 && (zero || branch > R))
        CHECK(out[k].force.y == doctest::Approx(branch).epsilon(1e-6).scale(S));
    }
    CHECK(least == doctest::Approx(zero ? 0.0 : R).epsilon(2e-3).scale(S));
    CHECK(out.back().force.y == doctest::Approx(R).epsilon(1e-12));
  }
}

TEST_CASE("dempack/energy: one bond dissipates the area under its branch, O(du^2) [(B53)]") {
  const Parameters p = tough();
  const Bond b = several_bonds(p)[1];
  const DempackLaw law = scene::law(p);
  const double u_l = stretch_limit(p, b), s_l = shear_limit(p, b);
  const double G_n = 0.5 * p.sigma_t * b.area * u_l * (1 + 0.8),
               G_s = 0.5 * p.tau_f * b.area * s_l * (1 + 0.6);
  const auto run = [&](const Path& path) { return follow<uncoupled, double>(law, {b}, {path})[0]; };
  const BondConstants<double> constants = constants_of_bond(b);
  /// Work by the trapezoid less what the bond says it has stored.
  const auto dissipated = [&](const Path& path) {
    const auto out = run(path);
    double work = 0;
    PathPoint a;
    Vec3 F;
    for (std::size_t k = 0; k < path.size(); a = path[k], F = out[k].force, ++k)
      work += 0.5 * dot(F + out[k].force, {path[k].u - a.u, path[k].y - a.y, path[k].z - a.z});
    return work - stored_energy(law, constants, out.back().history, b.d0 + path.back().u, false);
  };
  // a kink between two slopes inside a step is worth at most |change of slope| du^2/8
  const auto off_n = [&](int steps, double far) {
    return b.k_n * (1 + 2 / 0.8) * std::pow(far / steps, 2) / 8;
  };
  const auto off_s = [&](int steps, double far) {
    return b.k_s * (1 + 2 / 0.6) * std::pow(far / steps, 2) / 8;
  };
  for (const int steps : {37, 101, 1009, 10007}) {
    CHECK(std::abs(dissipated(along({{2 * u_l}}, steps)) - G_n) < off_n(steps, 2 * u_l) + 1e-10 * G_n);
    CHECK(std::abs(dissipated(along({{0, 2 * s_l}}, steps)) - G_s) < off_s(steps, 2 * s_l) + 1e-10 * G_s);
    // part of the way: the share D of it is gone, the rest is stored, on the branch and unloaded
    // alike
    const double u = 1.4 * u_l, s = 1.3 * s_l;  // D = 1/2
    for (const double back : {1.0, 0.3}) {
      CHECK(std::abs(dissipated(along({{u}, {back * u}}, steps)) - 0.5 * G_n) <
            off_n(steps, u) + 1e-10 * G_n);
      CHECK(std::abs(dissipated(along({{0, 0, s}, {0, 0, back * s}}, steps)) - 0.5 * G_s) <
            off_s(steps, s) + 1e-10 * G_s);
    }
    // under pressure: the area between branch and Coulomb line is damage, on the line it is
    // friction
    const double N = 10e6 * b.area, S = p.tau_f * b.area + p.mu1 * N, R = p.mu2 * N, y_l = S / b.k_s,
                 y_end = 2 * y_l;
    Path path = along({{-N / b.k_n, 0}, {-N / b.k_n, y_end}}, steps);
    path.erase(path.begin(), path.begin() + steps - 1);
    const double y_r = y_l * (1 + 0.6 * (1 - R / S));
    const double want = 0.5 * S * y_l + 0.5 * (S + R) * (y_r - y_l) + R * (y_end - y_r) - 0.5 * R * R / b.k_s;
    CHECK(std::abs(dissipated(path) - want) < off_s(steps, y_end) + 1e-10 * want);
  }
  // no shear stiffness (a matched material of nu = 0.25): finite
  DempackLaw slippery = law;
  slippery.shear_ratio = 0;
  CHECK(stored_energy(slippery, constants, {}, b.d0 + 0.5 * u_l, false) ==
        doctest::Approx(0.125 * b.k_n * u_l * u_l).epsilon(1e-9));
  // elastic in all directions: nothing is lost
  CHECK(std::abs(dissipated(along({{0.9 * u_l, 0.5 * s_l, 0.5 * s_l}, {-u_l, -0.3 * s_l}}, 40))) <
        1e-12 * G_s);
}

TEST_CASE(
    "dempack/padding: bonds without area and stiffness give exact zeros beside bonds in any "
    "state") {
  const auto with = [&]<Features features, class R>(R) {
    Parameters p = tough();
    p.criterion = static_cast<ref::Criterion>(features.criterion);
    std::mt19937_64 random(5);
    std::vector<Bond> bonds;
    std::vector<Path> paths;
    for (int k = 0; k < 64; ++k) {
      Bond b = bond_between(p, 0.01, 0.012, 0.021);
      paths.push_back(random_path(p, b, random));
      if (k % 2 == 1) b.area = b.k_n = b.k_s = b.c_n = 0;
      bonds.push_back(b);
    }
    const auto got = follow<features, R>(scene::law(p), bonds, paths);
    bool zero = true, others = false;
    for (std::size_t k = 0; k < bonds.size(); ++k)
      for (const Outcome& o : got[k]) {
        if (k % 2 == 0)
          others = others || o.history.damage_normal > 0;
        else
          zero = zero && o.force == Vec3{} && o.history.shear == Vec3{} && o.history.plastic_stretch == 0 &&
                 o.history.damage_normal == 0 && o.history.damage_shear == 0;
      }
    CHECK(others);
    CHECK(zero);
  };
  const auto of_each_width = [&]<Features features>() {
    with.template operator()<features>(double{});
    with.template operator()<features>(stdx::native_simd<double>{});
    with.template operator()<features>(stdx::fixed_size_simd<double, 8>{});
  };
  of_each_width.template operator()<uncoupled>();
  of_each_width.template operator()<coupled>();
  of_each_width.template operator()<mohr_coulomb>();
}
