// A close-packed lattice of discs is an isotropic plane whose E and nu follow exactly from k_n and
// k_s: Tavarez and Plesha, Int. J. Numer. Meth. Engng 70 (2007) 379-404, as in Santasusana's
// thesis, eqs. 5.5 and 5.6.
#include <doctest/doctest.h>

#include "core/fields/stress.hpp"
#include "core/stepping/step.hpp"
#include "core/world/make_world.hpp"
#include "tests/scene.hpp"

using namespace breccia;

namespace {

constexpr double radius = 1e-3;

/// Discs in the x-z plane, the one in the middle at the origin.
std::vector<scene::Ball> lattice(int half) {
  std::vector<scene::Ball> balls;
  Gid id = 0;
  for (int row = -half; row <= half; ++row)
    for (int k = -half; k <= half; ++k)
      balls.push_back(
          {++id, radius, {radius * (2 * k + std::abs(row % 2)), 0, std::sqrt(3.0) * radius * row}});
  return balls;
}

/// Pa; stress of the disc in the middle after the lattice has been deformed evenly through the bond
/// pass.
Stress stress_at(double e_x, double e_z, double E, double nu) {
  const auto balls = lattice(4);
  const Features features = ContactBondLaw::feature_sets[0];
  Assembly a = scene::free_body(balls, 0.01, features);
  a.space = Space::two_d;
  const double cell = 2 * std::sqrt(3.0) * radius * radius;
  a.body = {Shape::box, 1, 1, double(balls.size()) * cell};  // every disc stands for one cell
  Material m;
  m.law = "contact-bond";
  m.density = 2500;
  m.young_modulus = E;
  m.own["normal_stiffness"] = E / (std::sqrt(3.0) * (1 - nu));
  m.own["shear_stiffness"] = (1 - 3 * nu) / (1 + nu) * m.own["normal_stiffness"];
  m.own["normal_strength"] = m.own["bond_shear_strength"] = 1e12;
  WorldOptions options;
  options.features = features;
  options.contact_damping = 0;
  options.new_contacts = false;
  World w = make_world(a, m, AreaFactor{}, options);
  ParticleTable& p = w.particles;
  for (std::size_t k = 0; k < p.size; ++k) {
    const Vec3 u{e_x * p.position[k].x, 0, e_z * p.position[k].z};
    p.position[k] += u;
    p.velocity[k] = (1 / w.dt) * u;
  }
  const Column<Vec3> deformed = p.position.copy();
  advance(w);
  p.position.fill(deformed);  // the forces belong to these
  fill_stress_columns(w);
  std::size_t middle = 0;
  for (std::size_t k = 0; k < p.size; ++k)
    if (norm(p.reference_position[k]) < norm(p.reference_position[middle])) middle = k;
  CHECK(norm(p.reference_position[middle]) == 0);
  return {p.stress_normal[middle], p.stress_shear[middle]};
}

}  // namespace

TEST_CASE("hexagonal lattice of discs: E and nu from k_n and k_s [Santasusana eqs. 5.5 and 5.6, rel 1e-6]") {
  const double E = 20e9, small = 1e-8;
  for (const double nu : {0.1, 0.2, 0.3}) {
    const Stress along_x = stress_at(small, 0, E, nu), along_z = stress_at(0, small, E, nu);
    const double c11 = along_x.normal.x / small, c33 = along_z.normal.z / small;
    const double c13 = along_x.normal.z / small, c31 = along_z.normal.x / small;
    CHECK(c33 == doctest::Approx(c11).epsilon(1e-6));  // isotropic
    CHECK(c31 == doctest::Approx(c13).epsilon(1e-6));
    CHECK(c33 - c13 * c31 / c11 == doctest::Approx(E).epsilon(1e-6));
    CHECK(c13 / c11 == doctest::Approx(nu).epsilon(1e-6));
    CHECK(along_z.normal.y == 0);
    CHECK(std::abs(along_z.shear.y) < 1e-9 * along_z.normal.z);
  }
}
