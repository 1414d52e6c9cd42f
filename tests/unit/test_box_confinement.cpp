// Pressure on the four lateral faces of a box (docs/model.md, B121).
#include <doctest/doctest.h>

#include <cmath>

#include "core/fields/stress.hpp"
#include "core/packing/packing.hpp"
#include "core/stepping/step.hpp"
#include "tests/scene.hpp"

using namespace breccia;

namespace {

const Body box{Shape::box, 0.06, 0.04, 0.05};

World pressed_box(double on_x, double on_y) {
  PackRequest r;
  r.spheres = 700;
  reference::Parameters p;
  p.breakage = p.plasticity = false;
  WorldOptions o = scene::options(p);
  o.features = scene::features(p);
  o.rough_platens = false;
  World w = make_world(assemble(pack_spheres(box, r), box, {}, o.features, 1), scene::material_of(p),
                       scene::factor(p), o);
  w.confinement.pressure_x = on_x;
  w.confinement.pressure = on_y;
  return w;
}

}  // namespace

TEST_CASE("box confinement: each pair of faces is in balance and carries its pressure [(B121), 1e-9; 3 %]") {
  World w = pressed_box(7e6, 3e6);
  Confinement& c = w.confinement;
  REQUIRE(c.prism);
  std::fill(w.particles.force.begin(), w.particles.force.end(), Vec3{});
  apply_confinement(c, w.particles, w.partition);
  Vec3 net, moment;
  double on_x = 0, on_y = 0, at_edges = 0;
  for (std::size_t k = 0; k < c.rows.size(); ++k) {
    const Vec3& f = c.force[k];
    CHECK(norm(f - w.particles.force[c.rows[k]]) == 0.0);
    net += f;
    moment += cross(w.particles.position[c.rows[k]], f);
    on_x += std::abs(f.x), on_y += std::abs(f.y);
    at_edges += f.x != 0.0 && f.y != 0.0;
    CHECK(f.z == 0.0);
    if (c.weight_x[k] == 0.0) CHECK(f.x == 0.0);
  }
  CHECK(at_edges > 10);
  const double face_x = 0.04 * 0.05, face_y = 0.06 * 0.05;
  CHECK(norm(net) < 1e-9 * 7e6 * face_x);
  CHECK(norm(moment) < 1e-9 * 7e6 * face_x * 0.06);
  CHECK(on_x == doctest::Approx(2 * 7e6 * face_x).epsilon(0.03));
  CHECK(on_y == doctest::Approx(2 * 3e6 * face_y).epsilon(0.03));
  CHECK(c.acting == doctest::Approx(3e6).epsilon(0.03));
  // the weights themselves are exact
  double all_x = 0, all_y = 0;
  for (std::size_t k = 0; k < c.rows.size(); ++k)
    all_x += std::abs(c.weight_x[k]), all_y += std::abs(c.weight[k]);
  CHECK(all_x == doctest::Approx(2 * face_x).epsilon(1e-12));
  CHECK(all_y == doctest::Approx(2 * face_y).epsilon(1e-12));
}

TEST_CASE("box confinement: at rest the bonds hold both pressures: the virial is p V each way [5 %]") {
  World w = pressed_box(7e6, 3e6);
  w.platens.velocity = {};
  for (int k = 0; k < 6000; ++k) advance(w);
  // sum of outward forces times place is twice the pressure's part; x and y apart
  double x = 0, y = 0;
  for (std::size_t k = 0; k < w.confinement.rows.size(); ++k) {
    const Vec3& at = w.particles.position[w.confinement.rows[k]];
    x -= at.x * w.confinement.force[k].x, y -= at.y * w.confinement.force[k].y;
  }
  const double volume = 0.06 * 0.04 * 0.05;
  CHECK(x / volume == doctest::Approx(7e6).epsilon(0.15));  // centres lie within the faces by a radius
  CHECK(y / volume == doctest::Approx(3e6).epsilon(0.2));
  CHECK(held_pressure(w) == doctest::Approx(w.confinement.pressure).epsilon(0.02));
}

TEST_CASE("box confinement: what has been squeezed out past the other faces is pressed no more") {
  World w = pressed_box(7e6, 3e6);
  Confinement& c = w.confinement;
  std::size_t k = 0;
  while (c.weight_x[k] == 0.0) ++k;
  const Row row = c.rows[k];
  w.particles.position[row].y =
      std::copysign(std::abs(w.particles.reference_position[row].y) + 1.01 * w.particles.radius[row], 1.0);
  apply_confinement(c, w.particles, w.partition);
  CHECK(c.force[k].x == 0.0);
  w.particles.position[row].y = w.particles.reference_position[row].y;
  apply_confinement(c, w.particles, w.partition);
  CHECK(c.force[k].x * w.particles.position[row].x < 0.0);
}
