// What acts on a specimen from outside: pressure on the lateral surface, platens, their servo.
#include <doctest/doctest.h>

#include "core/stepping/step.hpp"
#include "core/world/energies.hpp"
#include "core/world/make_world.hpp"
#include "kernels/loops/integrate.hpp"
#include "tests/scene.hpp"

using namespace breccia;

namespace {

Assembly packed(std::size_t spheres) {
  return assemble(scene::small_packing(spheres), scene::small_cylinder(), {}, Features{}, 1);
}

}  // namespace

TEST_CASE(
    "boundary: the weights of the lateral surface add up to the nominal lateral surface, in the ratio of r^2 "
    "[(B71), rel "
    "1e-13]") {
  const Assembly a = packed(400);
  const Confinement c = make_confinement(a, SkinWeights::radius, false);
  double sum = 0;
  for (const double w : c.weight) sum += w;
  CHECK(sum == doctest::Approx(std::numbers::pi * 0.05 * 0.10).epsilon(1e-13));
  REQUIRE(c.rows.size() > 100);
  REQUIRE(c.rows == a.lateral);
  const double per_square = c.weight[0] / std::pow(a.particles.radius[c.rows[0]], 2);
  for (std::size_t k = 0; k < c.rows.size(); ++k)
    CHECK(c.weight[k] ==
          doctest::Approx(per_square * std::pow(a.particles.radius[c.rows[k]], 2)).epsilon(1e-13));
  for (std::size_t row = 0; row < a.particles.size; ++row) {
    const Vec3& x = a.particles.position[row];
    const bool near = std::hypot(x.x, x.y) + a.particles.radius[row] > 0.025 - 0.3 * a.mean_radius;
    CHECK(near == std::binary_search(a.lateral.begin(), a.lateral.end(), static_cast<Row>(row)));
  }
}

TEST_CASE(
    "boundary: net force and all three moments of the pressure vanish [(B72), 1e-13 of the sum of "
    "forces]") {
  Assembly a = packed(400);
  Confinement c = make_confinement(a, SkinWeights::radius, false);
  c.pressure = 9e6;
  for (Vec3& x : a.particles.position)
    x = {1.03 * x.x + 0.0004 + 0.01 * x.z, 0.97 * x.y - 0.0002, 0.98 * x.z + 0.0003};
  apply_confinement(c, a.particles, serial_partition(a.particles.size));
  Vec3 net, moment;
  double size = 0, inward = 0;
  for (std::size_t k = 0; k < c.rows.size(); ++k) {
    const Vec3 &x = a.particles.position[c.rows[k]], &f = c.force[k];
    CHECK(a.particles.force[c.rows[k]] == f);
    net += f;
    moment += cross(x, f);
    size += norm(f);
    inward -= (f.x * x.x + f.y * x.y) / std::hypot(x.x, x.y);
    CHECK(f.z == 0);
  }
  CHECK(norm(net) < 1e-13 * size);
  CHECK(std::abs(moment.x) < 1e-13 * size * 0.05);
  CHECK(std::abs(moment.y) < 1e-13 * size * 0.05);
  CHECK(std::abs(moment.z) < 1e-13 * size * 0.025);
  CHECK(inward == doctest::Approx(9e6 * a.lateral_surface()).epsilon(0.01));  // the correction is small
  for (std::size_t row = 0; row < a.particles.size; ++row)
    if (!std::binary_search(a.lateral.begin(), a.lateral.end(), static_cast<Row>(row)))
      CHECK(a.particles.force[row] == Vec3{});
}

TEST_CASE(
    "boundary: a servo on a spring comes to rest where the reaction is the pressure, without overshoot "
    "[(B66), 1e-9]") {
  const Assembly a = packed(300);
  Assembly heavy = a;
  for (std::size_t k = 0; k < a.particles.size; ++k)
    heavy.particles.mass[k] = 2500 * 4.0 / 3.0 * std::numbers::pi * std::pow(a.particles.radius[k], 3);
  Platens p = make_platens(heavy, heavy.particles, true, 28e9);
  p.servo = true;
  p.pressure = 9e6;
  ParticleTable t = heavy.particles;
  const double spring = 28e9 * p.section / 0.10, dt = 5e-7;
  double most = 0;
  for (int k = 0; k < 20000; ++k) {
    // the specimen's reaction, shared among the held particles
    const double force = spring * approach(p);
    std::fill(t.force.begin(), t.force.end(), Vec3{});
    t.force[t.free].z = -0.25 * force, t.force[a.first_top - 1].z += -0.75 * force;
    t.force[a.first_top].z = 0.5 * force, t.force[t.size - 1].z += 0.5 * force;
    drive_platens(p, t, serial_partition(t.size), a.first_top, {}, dt);
    most = std::max(most, scene::platen_stress(p)[0]);
  }
  for (const double stress : scene::platen_stress(p)) CHECK(stress == doctest::Approx(9e6).epsilon(1e-9));
  CHECK(axial_stress(p) == doctest::Approx(9e6).epsilon(1e-9));
  CHECK(mismatch(p) < 1e-9 * 9e6);
  CHECK(most < 9e6 * 1.001);
  CHECK(p.travel[0].z == doctest::Approx(-p.travel[1].z).epsilon(0.2));  // towards each other
  CHECK(p.travel[0].z > 0);
  CHECK(norm(p.velocity[0]) < 1e-9);
}

TEST_CASE(
    "boundary: a packing under servo and lateral surface pressure comes to rest at that pressure [0.5 %, the "
    "stop "
    "test's own band]") {
  const Assembly a = packed(200);
  reference::Parameters m;
  m.alpha = 0.75;
  m.damping_translation = m.damping_rotation = 0.1;
  World w = make_world(a, scene::material_of(m), scene::factor(m), scene::options(m));
  w.platens.servo = true;
  w.platens.pressure = w.confinement.pressure = 3e6;
  for (int k = 0; k < 6000; ++k) advance(w);
  for (const double stress : scene::platen_stress(w.platens))
    CHECK(stress == doctest::Approx(3e6).epsilon(0.005));
  CHECK(w.platens.travel[0].z > 0);
  CHECK(kinetic_energy(w) < 1e-4 * stored_energy(w));
}

TEST_CASE("boundary: without a servo platens keep their speed and read reactions per section [exact]") {
  const Assembly a = packed(200);
  Platens p = make_platens(a, a.particles, true, 28e9);
  ParticleTable t = a.particles;
  t.force[t.free] = {3, 5, -70}, t.force[a.first_top] = {-7, 1, 90}, t.force[0].z = 1e9;
  p.velocity = {Vec3{0.03, 0, 0.1}, Vec3{0, 0, -0.2}};
  drive_platens(p, t, serial_partition(t.size), a.first_top, {}, 1e-3);
  CHECK(p.force[0] == Vec3{3, 5, -70});
  CHECK(p.force[1] == Vec3{-7, 1, 90});
  CHECK(axial_stress(p) == doctest::Approx(80 / p.section).epsilon(1e-14));
  CHECK(mismatch(p) == doctest::Approx(20 / p.section).epsilon(1e-14));
  CHECK(shear_stress(p) == doctest::Approx(5 / p.section).epsilon(1e-14));
  CHECK(p.section == doctest::Approx(std::numbers::pi * 0.025 * 0.025).epsilon(1e-14));
  CHECK(p.velocity[0] == Vec3{0.03, 0, 0.1});
  CHECK(p.travel[0].z == doctest::Approx(1e-4).epsilon(1e-14));
  CHECK(p.travel[1].z == doctest::Approx(-2e-4).epsilon(1e-14));
  CHECK(approach(p) == doctest::Approx(3e-4).epsilon(1e-14));
  CHECK(shear_travel(p) == doctest::Approx(-3e-5).epsilon(1e-14));
}

TEST_CASE(
    "boundary: rough platens fix lateral motion, smooth ones leave it free, spins are free, global damping "
    "[(B64)]") {
  for (const bool rough : {true, false}) {
    std::vector<Vec3> x(1), v{{3, 0, 7}}, w{{0, 0, 2}}, f{{0, 5, 100}}, t{{0, 0, 4}};
    const std::vector<double> m{2}, r{0.5};
    integrate_held({x, v, w, f, t, m, r}, 0, 1, 1e-2, {0.1, 0.2},
                   {Vec3{rough ? 0.5 : 9.0, 0, -0.25}, !rough});
    CHECK(v[0].z == -0.25);
    CHECK(v[0].x == doctest::Approx(rough ? 0.5 : 3 - 1e-2 / 2 * 0.1 * 5).epsilon(1e-14));
    CHECK(v[0].y == doctest::Approx(rough ? 0 : 1e-2 / 2 * 5).epsilon(1e-14));
    CHECK(x[0].z == doctest::Approx(-0.0025).epsilon(1e-14));
    CHECK(x[0].y == doctest::Approx(1e-2 * v[0].y).epsilon(1e-14));
    CHECK(w[0].z == doctest::Approx(2 + 1e-2 / 0.2 * (4 - 0.2 * 4)).epsilon(1e-14));
    CHECK(f[0] == Vec3{});
    CHECK(t[0] == Vec3{});
  }
}

TEST_CASE(
    "boundary: the pressure that acts is the inward force over the nominal surface, correction and all") {
  for (const bool lopsided : {false, true}) {
    Assembly a = packed(400);
    if (lopsided) {  // three neighbours are found: what does not balance is taken out again
      std::erase_if(a.lateral, [&](Row row) { return a.particles.position[row].x < 0.020; });
      a.lateral.resize(3);
    }
    Confinement c = make_confinement(a, SkinWeights::radius, false);
    c.pressure = 9e6;
    apply_confinement(c, a.particles, serial_partition(a.particles.size));
    double inward = 0;
    for (std::size_t k = 0; k < c.rows.size(); ++k) {
      const Vec3& x = a.particles.position[c.rows[k]];
      inward -= (c.force[k].x * x.x + c.force[k].y * x.y) / std::hypot(x.x, x.y);
    }
    CHECK(c.acting == doctest::Approx(inward / (std::numbers::pi * 0.05 * 0.10)).epsilon(1e-10));
    CHECK((std::abs(c.acting / 9e6 - 1) < 0.02) == !lopsided);
  }
}

TEST_CASE("boundary: a sphere on the axis gets no lateral force, and no other a number that is none") {
  Assembly a = packed(400);
  Confinement c = make_confinement(a, SkinWeights::radius, false);
  c.pressure = 9e6;
  a.particles.position[c.rows[7]] = {0, 0, 0.01};
  apply_confinement(c, a.particles, serial_partition(a.particles.size));
  for (const Vec3& f : c.force) REQUIRE(std::isfinite(norm(f)));
  CHECK(norm(c.force[7]) < 0.05 * norm(c.force[8]));  // but for the correction, which all share
  CHECK(!is_one_sphere_wide(a));
  c.rigid = true;
  restrain_laterally(c, a.particles, serial_partition(a.particles.size));
  CHECK(std::isfinite(c.acting));
}

TEST_CASE("boundary: the cover of the lateral surface, in packings 0.65 to 0.9") {
  const Assembly a = packed(400);
  double sum = 0;
  for (const Row row : a.lateral) sum += std::numbers::pi * std::pow(a.particles.radius[row], 2);
  CHECK(lateral_cover(a) == doctest::Approx(sum / (std::numbers::pi * 0.05 * 0.10)).epsilon(1e-12));
  CHECK(lateral_cover(a) > 0.65);
  CHECK(lateral_cover(a) < 0.9);
}

TEST_CASE("boundary: pressure on the surface as it is, 2 pi R H after a stretch [(B115), 1e-12]") {
  Assembly a = packed(400);
  Confinement c = make_confinement(a, SkinWeights::radius, false);
  c.current = true, c.pressure = 9e6;
  for (Vec3& x : a.particles.position) x = {1.03 * x.x, 1.03 * x.y, 0.9 * x.z};
  Platens platens;
  platens.travel = {Vec3{0, 0, 0.005}, Vec3{0, 0, -0.005}};  // a tenth of 100 mm
  measure_surface(c, a.particles, serial_partition(a.particles.size), platens);
  CHECK(c.grown == doctest::Approx(1.03 * 0.9).epsilon(1e-12));
  apply_confinement(c, a.particles, serial_partition(a.particles.size));
  double inward = 0;
  for (std::size_t k = 0; k < c.rows.size(); ++k) {
    const Vec3& x = a.particles.position[c.rows[k]];
    inward -= (c.force[k].x * x.x + c.force[k].y * x.y) / std::hypot(x.x, x.y);
  }
  const double surface = std::numbers::pi * 0.05 * 1.03 * 0.1 * 0.9;
  CHECK(inward / surface == doctest::Approx(c.acting).epsilon(1e-12));
  CHECK(c.acting == doctest::Approx(9e6).epsilon(5e-3));
}
