// The laws of KDEM and of the contact bond: stiffnesses, strengths, friction; what the world makes
// of them.
#include <doctest/doctest.h>

#include "core/bonding/law_of_material.hpp"
#include "core/world/loop_views.hpp"
#include "core/world/make_world.hpp"
#include "tests/follow.hpp"
#include "tests/scene.hpp"

using namespace breccia;
using scene::Ball, scene::Outcome, scene::Path;
namespace stdx = std::experimental;

namespace {

constexpr Features features{.plasticity = false};

Material kdem_material() {
  Material m;
  m.law = "kdem";
  m.density = 2500;
  m.young_modulus = 28e9;
  m.poisson_ratio = 0.2;
  m.friction_static = 0.9;
  m.friction_dynamic = 0.25;
  m.tensile_strength = 5e6;
  m.shear_strength = 16e6;
  m.own = {{"normal_factor", 1.3}, {"shear_factor", 0.7}};
  return m;
}

Material glue_material() {
  Material m;
  m.law = "contact-bond";
  m.density = 2500;
  m.young_modulus = 2e10;
  m.friction_dynamic = 0.5;
  m.own = {{"normal_stiffness", 2e10},
           {"shear_stiffness", 5e9},
           {"normal_strength", 8e3},
           {"bond_shear_strength", 2e4}};
  return m;
}

/// Bonds along paths with the forces wanted, in every kind of register.
template <class Law>
void hold(const Law& law, const std::vector<BondConstants<double>>& bonds, const std::vector<Path>& paths,
          const std::vector<std::vector<Vec3>>& want, double scale) {
  const auto check = [&](const char* width, const std::vector<std::vector<Outcome>>& got) {
    double worst = 0;
    for (std::size_t k = 0; k < bonds.size(); ++k) {
      REQUIRE(got[k].size() == want[k].size());
      for (std::size_t n = 0; n < want[k].size(); ++n) {
        const double miss = norm(got[k][n].force - want[k][n]) / scale;
        worst = miss <= worst ? worst : miss;
      }
    }
    INFO(width);
    CHECK(worst < 1e-11);
  };
  check("double", scene::follow<features, double>(law, bonds, paths));
  check("native", scene::follow<features, stdx::native_simd<double>>(law, bonds, paths));
  check("8 lanes", scene::follow<features, stdx::fixed_size_simd<double, 8>>(law, bonds, paths));
}

/// Pairs of unequal spheres or discs far from each other.
Assembly pairs(const std::vector<std::pair<double, double>>& radii, const Features& of, Space space) {
  std::vector<Ball> balls;
  for (const auto& [r, s] : radii) {
    const double x = 0.1 * double(balls.size());
    balls.push_back({balls.size() + 1, r, {x, 0, 0}});
    balls.push_back({balls.size() + 1, s, {x, 0, r + s}});
  }
  Assembly a = scene::free_body(balls, 0.01, of);
  a.space = space;
  return a;
}

}  // namespace

TEST_CASE("kdem: factors alpha and beta on k_n = E A/d0 and k_s = E A/(2 (1 + nu) d0) [(S5.7) rel 1e-13]") {
  const Assembly a = pairs({{0.01, 0.01}, {0.004, 0.01}, {0.003, 0.002}}, features, Space::three_d);
  AreaFactor factor;
  factor.shear_ratio = paper_shear_ratio(0.2);
  WorldOptions o;
  o.features = features;
  const World w = make_world(a, kdem_material(), factor, o);
  REQUIRE(w.bonds.size == 3);
  const double smaller[] = {0.01, 0.004, 0.002}, length[] = {0.02, 0.014, 0.005};
  for (std::size_t k = 0; k < 3; ++k) {
    const double plain = 28e9 * std::numbers::pi * smaller[k] * smaller[k] / length[k];
    CHECK(w.bonds.stiffness[k] == doctest::Approx(1.3 * plain).epsilon(1e-13));
    CHECK(w.shear_ratio.front() * w.bonds.stiffness[k] == doctest::Approx(0.7 * plain / 2.4).epsilon(1e-13));
  }
}

TEST_CASE(
    "kdem: elastic and brittle in tension and in shear - whatever the factors - friction afterwards [(S5.7) "
    "1e-11]") {
  const Material m = kdem_material();
  const KdemLaw law = std::get<KdemLaw>(law_of(m, paper_shear_ratio(m.poisson_ratio)));
  std::vector<BondConstants<double>> bonds;
  std::vector<Path> paths;
  std::vector<std::vector<Vec3>> want;
  for (const auto& [d0, A] : {std::pair{0.02, 3e-4}, {0.03, 1e-4}, {0.004, 8e-4}}) {
    const double k_n = 1.3 * 28e9 * A / d0, k_s = 0.7 * 28e9 * A / d0 / 2.4;
    const double T = 5e6 * A, S = 16e6 * A, u = T / k_n, y = S / k_s;
    // pulled; pushed harder than any limit of another law; torn; pressed again
    bonds.push_back({d0, A, A, k_n, 0});
    paths.push_back({{0.5 * u}, {-40 * u}, {0.9999 * u}, {1.0001 * u}, {0.5 * u}, {-u}, {-u, 9 * y, 0}});
    want.push_back(
        {{0.5 * T, 0, 0}, {-40 * T, 0, 0}, {0.9999 * T, 0, 0}, {}, {}, {-T, 0, 0}, {-T, 0.25 * T, 0}});
    // sheared, open; tension does not weaken it
    bonds.push_back({d0, A, A, k_n, 0});
    paths.push_back({{0.9 * u, 0.5 * y}, {0.9 * u, 0.9999 * y}, {0.9 * u, 1.0001 * y}, {-u, 1.0001 * y}});
    want.push_back({{0.9 * T, 0.5 * S, 0}, {0.9 * T, 0.9999 * S, 0}, {}, {-T, 0, 0}});
    // sheared under pressure: mu_1 before, mu_2 after
    const double N = 2 * T, strong = S + 0.9 * N;
    bonds.push_back({d0, A, A, k_n, 0});
    paths.push_back({{-2 * u}, {-2 * u, 0.9999 * strong / k_s}, {-2 * u, 1.0001 * strong / k_s}});
    want.push_back({{-N, 0, 0}, {-N, 0.9999 * strong, 0}, {-N, 0.25 * N, 0}});
  }
  // rounding of distances: of d0 against the small stretches
  hold(law, bonds, paths, want, 16e6 * 8e-4);
}

TEST_CASE("contact bond: k_n and k_s and the damping's k_n do not depend on the radii [(B28) exact]") {
  const Assembly a = pairs({{0.01, 0.01}, {0.004, 0.01}, {0.003, 0.002}}, features, Space::two_d);
  WorldOptions o;
  o.features = features;
  for (const double alpha : {1.0, 3.0}) {  // nor on any factor of areas
    AreaFactor factor;
    factor.alpha = alpha;
    factor.shear_ratio = 0.1234;  // the law has its own
    const World w = make_world(a, glue_material(), factor, o);
    for (std::size_t k = 0; k < w.bonds.size; ++k) {
      CHECK(w.bonds.stiffness[k] == 2e10);
      CHECK(w.shear_ratio.front() * w.bonds.stiffness[k] == doctest::Approx(5e9).epsilon(1e-14));
      const double m = w.particles.mass[w.bonds.row_lo[k]], n = w.particles.mass[w.bonds.row_hi[k]];
      CHECK(w.bonds.damping[k] ==
            doctest::Approx(2 * 0.9 * std::sqrt(m * n / (m + n) * 2e10)).epsilon(1e-13));
    }
    CHECK(w.particles.mass[0] ==
          doctest::Approx(2500 * std::numbers::pi * 1e-4).epsilon(1e-14));  // a disc of 1 m
    CHECK(inertia_factor(w) == 0.5);
  }
}

TEST_CASE(
    "contact bond: n_b and s_b break it whatever the area - one does not lower the other - friction after "
    "[(B28) 1e-11]") {
  const ContactBondLaw law = std::get<ContactBondLaw>(law_of(glue_material(), 0.4));
  std::vector<BondConstants<double>> bonds;
  std::vector<Path> paths;
  std::vector<std::vector<Vec3>> want;
  const double k_n = 2e10, k_s = 5e9, n_b = 8e3, s_b = 2e4, u = n_b / k_n, y = s_b / k_s;
  for (const auto& [d0, A] : {std::pair{0.02, 0.02}, {0.03, 1e-3}, {0.004, 7.0}}) {
    for (int k = 0; k < 3; ++k) bonds.push_back({d0, A, A, k_n, 0});
    paths.push_back(
        {{0.5 * u, 0.9 * y}, {0.999 * u, 0.9 * y}, {1.001 * u, 0.9 * y}, {-u, 0.9 * y}, {-u, 2 * y}});
    want.push_back(
        {{0.5 * n_b, 0.9 * s_b, 0}, {0.999 * n_b, 0.9 * s_b, 0}, {}, {-n_b, 0, 0}, {-n_b, 0.5 * n_b, 0}});
    paths.push_back({{0.9 * u, 0.999 * y}, {0.9 * u, 1.001 * y}, {0.1 * u, 0}});
    want.push_back({{0.9 * n_b, 0.999 * s_b, 0}, {}, {}});
    // pressed with 2 n_b: s_b is no more for it; what is left is Coulomb's
    paths.push_back({{-2 * u, 0, 0}, {-2 * u, 0, 0.999 * y}, {-2 * u, 0, 1.001 * y}, {-2 * u, 0, -3 * y}});
    want.push_back({{-2 * n_b, 0, 0}, {-2 * n_b, 0, 0.999 * s_b}, {-2 * n_b, 0, n_b}, {-2 * n_b, 0, -n_b}});
  }
  // d0 + u - d0 keeps 1e-16/4e-7 of a stretch
  hold(law, bonds, paths, want, s_b * 20);
}
