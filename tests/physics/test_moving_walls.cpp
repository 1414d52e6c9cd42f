// Walls that move, against closed forms: docs/model.md, "Impacts", (B39).
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "tests/physics/impact_scenes.hpp"

using namespace breccia;
using namespace scene;

namespace {

ImpactMaterial stone(double restitution, double friction, double rolling = 0) {
  return {2500, 1e9, 0.25, friction, restitution, rolling};
}

constexpr double radius = 0.01;
const double mass = 2500 * 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;

}  // namespace

TEST_CASE("moving walls: a turned and shifted triangle is where a rigid body would be [1e-14]") {
  const Wall wall{WallKind::triangle, {1, 0, 0}, {0, 0, 1}, 0, {2, 0, 0}, {1, 1, 0}};
  const WallMotion motion{{0, 0, 3}, {0, 0, std::numbers::pi}, {1, 0, 0}, 1.0, 1.5};
  CHECK(placed(wall, motion, 1.0).second.x == 2.0);  // not begun
  for (const double time : {1.5, 7.0}) {             // a quarter turn, then at rest
    const Wall now = placed(wall, motion, time);
    CHECK(norm(now.point - Vec3{1, 0, 1.5}) < 1e-14);
    CHECK(norm(now.second - Vec3{1, 1, 1.5}) < 1e-14);
    CHECK(norm(now.third - Vec3{0, 0, 1.5}) < 1e-14);
    CHECK(norm(velocity_at(motion, time, {2, 0, 0})) == 0.0);
  }
  CHECK(norm(velocity_at(motion, 1.25, {1, 2, 0.75}) - Vec3{-2 * std::numbers::pi, 0, 3}) < 1e-14);
  // a drum's surface goes nowhere
  const Wall drum{WallKind::cylinder, {0, 0, 1}, {0, 1, 0}, 2, {}, {}};
  CHECK(surface_speed(drum, {{}, {0, 5, 0}, {0, 9, 1}}, 2.0) == 0.0);
  CHECK(surface_speed(drum, {{}, {0, 5, 0}, {0.1, 0, 1}}, 2.0) == 10.0);
}

TEST_CASE(
    "moving walls: a plane that hits a sphere is a sphere that hits a plane, and its work 2 m V^2 [1e-3]") {
  for (const double e : {1.0, 0.6}) {
    ImpactScene s = sphere_on_plane(stone(e, 0.3), radius, {});
    s.wall_names = {"bat"};
    s.walls[0].motion.velocity = {0.2, 0, 1};
    s.walls[0].material = 0;
    s.duration = 2e-3;
    const ImpactResult hit = run(s);
    ImpactScene t = sphere_on_plane(stone(e, 0.3), radius, {-0.2, 0, -1});
    t.wall_names = {"bat"};
    t.walls[0].material = 0;
    t.duration = 2e-3;
    const ImpactRecord wanted = run(t).particles[0], got = hit.particles[0];
    CHECK(norm(got.velocity - Vec3{0.2, 0, 1} - wanted.velocity) < 1e-3);
    CHECK(norm(got.spin - wanted.spin) < 1e-3 * norm(wanted.spin));
    CHECK(got.largest_force == doctest::Approx(wanted.largest_force).epsilon(1e-3));
    if (e < 1.0) continue;
    CHECK(got.velocity.z == doctest::Approx(2.0).epsilon(1e-3));
    // what the wall did is what the sphere got, but for friction's heat
    const double along = mass * (got.velocity.z * 1.0 + got.velocity.x * 0.2);  // impulse times velocity
    CHECK(hit.wall_rows.back()[0].work == doctest::Approx(along).epsilon(1e-3));
  }
}

TEST_CASE("moving walls: a sphere in a turning drum rolls as its wall does, and climbs to tan = mu_r [1 %]") {
  for (const double mu_r : {0.0, 0.1}) {
    ImpactScene s;
    s.materials = {stone(0.3, 0.5, mu_r)};
    s.particles = {{{0, 0, -0.09}, {}, {}, radius, 0}};
    s.walls = {{Wall{WallKind::cylinder, {}, {0, 1, 0}, 0.1, {}, {}}, 0, {{}, {0, 2, 0}, {}}}};
    s.wall_names = {"drum"};
    s.gravity = {0, 0, -9.81};
    s.rolling = RollingModel::constant;
    s.duration = 6;
    s.safety = 0.4;
    s.rows = 100;
    const ImpactResult r = run(s);
    const ImpactRecord& p = r.particles[0];
    const Vec3 outward = (1.0 / norm(p.position)) * p.position;
    const Vec3 slip = p.velocity + cross(p.spin, radius * outward) - cross({0, 2, 0}, 0.1 * outward);
    CHECK(norm(slip) < 1e-3 * 0.2);
    // it swings about the place where the friction that turns it holds it
    const double wanted = std::atan(mu_r);
    // the drum carries the weight, and its torque holds it aside
    Vec3 force, torque;
    for (std::size_t k = 50; k < 100; ++k)
      force += 0.02 * r.wall_rows[k][0].force, torque += 0.02 * r.wall_rows[k][0].torque;
    CHECK(force.z == doctest::Approx(-mass * 9.81).epsilon(0.01));
    CHECK(torque.y ==
          doctest::Approx(-mass * 9.81 * 0.09 * std::sin(wanted)).epsilon(0.02).scale(mass * 0.1));
  }
}

TEST_CASE("moving walls: a lid with a load comes to rest where the sphere under it carries the load [1e-3]") {
  ImpactScene s = sphere_on_plane(stone(0.2, 0), radius, {});
  s.walls[0].material = 0;
  s.walls.push_back({Wall{WallKind::plane, {0, 0, 2.001 * radius}, {0, 0, -1}, 0, {}, {}}, 0});
  s.walls[1].load = 50, s.walls[1].mass = 0.5, s.walls[1].name = 1;
  s.wall_names = {"floor", "lid"};
  s.gravity = {0, 0, -1e-9};
  s.duration = 0.2;
  s.safety = 0.05;
  const ImpactResult r = run(s);
  CHECK(r.wall_rows.back()[1].force.z == doctest::Approx(50).epsilon(1e-3));
  CHECK(r.wall_rows.back()[0].force.z == doctest::Approx(-50).epsilon(1e-3));
  CHECK(std::abs(r.particles[0].velocity.z) < 1e-4);
  s.walls[1].mass = 1e-9;
  ImpactResult light;
  CHECK_THROWS_WITH_AS(run_impact(s, light), doctest::Contains("too light"), SimulationBroke);
}
