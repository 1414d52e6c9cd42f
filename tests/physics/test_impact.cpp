// What every impact must keep: momentum, energy, the coefficient of restitution, whatever it meets.
#include <doctest/doctest.h>

#include <numbers>

#include "core/base/error.hpp"
#include "impact_scenes.hpp"

using namespace breccia;
using namespace scene;

namespace {

const ImpactMaterial stone{2600, 50e9, 0.25, 0.5, 1.0};

ImpactMaterial with_restitution(double e) {
  ImpactMaterial m = stone;
  m.friction = 0, m.restitution = e;
  return m;
}

double kinetic(const ImpactMaterial& m, double radius, const ImpactRecord& p) {
  const double mass = m.density * 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  return 0.5 * mass * (dot(p.velocity, p.velocity) + 0.4 * radius * radius * dot(p.spin, p.spin));
}

/// Two spheres of different sizes that meet off centre, spinning.
ImpactScene oblique(double friction, double restitution, ContactLaw law) {
  ImpactMaterial m = stone;
  m.friction = friction, m.restitution = restitution;
  ImpactScene s;
  s.materials = {m};
  s.law = law;
  s.particles = {{{0, 0, 0}, {2, 0.5, 0}, {30, -20, 50}, 0.01, 0},
                 {{0.0141, 0.0141, 0.005}, {-1, 0.3, -0.4}, {-10, 70, 20}, 0.008, 0}};
  const Vec3 l = s.particles[1].position;
  s.particles[1].position = (0.018001 / norm(l)) * l;  // 1 um apart
  s.duration = 2e-4;
  return s;
}

Vec3 angular_momentum(const ImpactScene& s, const std::vector<ImpactRecord>& records, bool start) {
  Vec3 sum;
  for (std::size_t k = 0; k < s.particles.size(); ++k) {
    const ImpactParticle& p = s.particles[k];
    const double m = p.radius * p.radius * p.radius;
    const Vec3 x = start ? p.position : records[k].position, v = start ? p.velocity : records[k].velocity,
               w = start ? p.spin : records[k].spin;
    sum += m * cross(x, v) + (0.4 * m * p.radius * p.radius) * w;
  }
  return sum;
}

}  // namespace

TEST_CASE("impact: momentum and angular momentum are kept by both laws [1e-12 and 1e-9]") {
  for (const ContactLaw law : {ContactLaw::linear, ContactLaw::hertz_mindlin}) {
    const ImpactScene s = oblique(0.5, 0.6, law);
    const ImpactResult r = run(s);
    REQUIRE(r.open_contacts == 0);
    REQUIRE(r.particles[0].largest_force > 100);
    Vec3 before, after;
    for (std::size_t k = 0; k < 2; ++k) {
      const double m = std::pow(s.particles[k].radius, 3);
      before += m * s.particles[k].velocity;
      after += m * r.particles[k].velocity;
    }
    CHECK(norm(after - before) < 1e-12 * norm(before));
    const Vec3 l = angular_momentum(s, r.particles, true);
    CHECK(norm(angular_momentum(s, r.particles, false) - l) < 1e-9 * norm(l));
  }
}

TEST_CASE("impact: an elastic frictionless impact keeps the energy [1e-6] - friction never adds any") {
  for (const ContactLaw law : {ContactLaw::linear, ContactLaw::hertz_mindlin}) {
    const ImpactResult smooth = run(oblique(0, 1, law));
    CHECK(smooth.kinetic_after == doctest::Approx(smooth.kinetic_before).epsilon(1e-6));
    for (const double friction : {0.05, 0.3, 1.0, 10.0}) {
      const ImpactResult r = run(oblique(friction, 1, law));
      CHECK(r.kinetic_after < r.kinetic_before);
    }
  }
}

TEST_CASE("impact: at the deepest point the stored energy is that of Hertz 8/15 E* sqrt(R*) u^(5/2) [1e-3]") {
  const ImpactResult r = run(head_on(with_restitution(1), 0.01, 3));
  double least = r.kinetic_before;
  for (const ImpactRow& row : r.rows) least = std::min(least, row.kinetic_J);
  const double modulus = 50e9 / (2 * (1 - 0.0625)), u = r.particles[0].largest_overlap;
  CHECK(least < 1e-4 * r.kinetic_before);
  CHECK(8.0 / 15 * modulus * std::sqrt(0.005) * std::pow(u, 2.5) ==
        doctest::Approx(r.kinetic_before).epsilon(1e-3));
}

TEST_CASE(
    "impact: the rebound speed is e times the approach speed by both laws [2e-3] - never after a pull") {
  for (const ContactLaw law : {ContactLaw::linear, ContactLaw::hertz_mindlin})
    for (const double e : {0.02, 0.1, 0.2, 0.4, 0.6, 0.8, 0.95, 1.0}) {
      ImpactScene s = head_on(with_restitution(e), 0.01, 1);
      s.law = law;
      s.duration *= e < 0.3 ? 4 : 2;
      const ImpactResult r = run(s);
      CHECK(r.open_contacts == 0);
      CHECK(-r.particles[0].velocity.x == doctest::Approx(e).epsilon(2e-3));
      for (const ImpactRow& row : r.rows) REQUIRE(row.normal_force_N >= 0);
    }
}

TEST_CASE("impact: the error of e falls with the step [first order]") {
  double error[2] = {0, 0};
  for (const int k : {0, 1})
    for (const double e : {0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9}) {
      ImpactScene s = head_on(with_restitution(e), 0.01, 1);
      s.duration *= 2;
      s.safety = k ? 0.01 : 0.08;
      error[k] = std::max(error[k], std::abs(-run(s).particles[0].velocity.x - e));
    }
  MESSAGE("error of e at 0.08 and 0.01 of the critical step: " << error[0] << ", " << error[1]);
  CHECK(error[1] < error[0] / 6);
  CHECK(error[1] < 1e-3);
}

TEST_CASE("impact: restitution under gravity: a ball comes up to e^2 of its height [5e-3]") {
  ImpactScene s = sphere_on_plane(with_restitution(0.7), 0.01, {});
  s.particles[0].position.z = 0.01 + 0.05;
  s.gravity = {0, 0, -9.81};
  const double fall = std::sqrt(2 * 0.05 / 9.81);
  s.duration = fall * 1.7;  // the top of the first bounce
  s.safety = 0.02;
  const ImpactResult r = run(s);
  CHECK(r.particles[0].position.z - 0.01 == doctest::Approx(0.49 * 0.05).epsilon(5e-3));
  CHECK(std::abs(r.particles[0].velocity.z) < 5e-3);
}

TEST_CASE("impact: velocities are measured where the positions are: free fall is exact [1e-10]") {
  ImpactScene s = sphere_on_plane(with_restitution(1), 0.01, {1, 0, 0});
  s.particles[0].position.z = 10;
  s.gravity = {0, 0, -10};
  s.duration = 0.5;
  s.safety = 0.5;
  const ImpactRecord p = run(s).particles[0];
  CHECK(p.velocity.z == doctest::Approx(-5).epsilon(1e-10));
  CHECK(p.position.z == doctest::Approx(10 - 1.25).epsilon(1e-10));
}

TEST_CASE(
    "impact: a triangle and the inside of a cylinder reflect like a plane where they are hit square [1e-6]") {
  const ImpactMaterial m = stone;
  const ImpactScene plane = sphere_on_plane(m, 0.01, {0.3, 0, -1});
  const ImpactRecord wanted = run(plane).particles[0];
  const auto near = [](const Vec3& a, const Vec3& b) { return norm(a - b) < 1e-6 * norm(b); };

  ImpactScene triangle = plane;
  triangle.walls[0].shape = {WallKind::triangle, {-1, -1, 0}, {0, 0, 1}, 0, {2, -1, 0}, {-1, 2, 0}};
  CHECK(near(run(triangle).particles[0].velocity, wanted.velocity));
  CHECK(near(run(triangle).particles[0].spin, wanted.spin));

  ImpactScene edge = triangle;  // two triangles that share the edge below: met once
  edge.walls[0].shape.point = {0, -1, 0}, edge.walls[0].shape.third = {0, 1, 0};
  edge.walls.push_back({{WallKind::triangle, {0, -1, 0}, {0, 0, 1}, 0, {0, 1, 0}, {-2, 0, 0}}, 1});
  for (const double x : {0.0, -1e-4, 1e-4}) {
    edge.particles[0].position.x = x;
    edge.particles[0].velocity = {0, 0, -1};
    const ImpactRecord p = run(edge).particles[0];
    CHECK(near(p.velocity, {0, 0, 1}));
    CHECK(p.largest_force ==
          doctest::Approx(run(sphere_on_plane(m, 0.01, {0, 0, -1})).particles[0].largest_force));
  }

  ImpactScene cylinder = plane;  // along y, hit at its bottom, in the plane of its axis
  cylinder.particles[0].velocity = {0, 0.3, -1};
  cylinder.walls[0].shape = {WallKind::cylinder, {0, 5, 0.5}, {0, 1, 0}, 0.5, {}, {}};
  const ImpactRecord p = run(cylinder).particles[0];
  CHECK(p.velocity.z == doctest::Approx(wanted.velocity.z).epsilon(1e-6));
  CHECK(p.velocity.y == doctest::Approx(wanted.velocity.x).epsilon(1e-6));
}

TEST_CASE("impact: the edge of a triangle throws a sphere off along the line from the edge [1e-3]") {
  // slow: the line from the edge hardly turns while they touch
  ImpactScene s = sphere_on_plane(with_restitution(1), 0.01, {0, 0, -0.01});
  s.walls[0].shape = {WallKind::triangle, {0, -1, 0}, {0, 0, 1}, 0, {0, 1, 0}, {-1, 0, 0}};
  s.particles[0].position = {0.006, 0, 0.008};  // nearest: the origin, on the edge x = 0
  const ImpactRecord p = run(s).particles[0];
  const Vec3 n{0.6, 0, 0.8};
  const Vec3 mirrored = Vec3{0, 0, -0.01} + (2 * 0.008) * n;
  CHECK(norm(p.velocity - mirrored) < 1e-3 * 0.01);
}

TEST_CASE("impact: a sphere that rolls round inside a cylinder keeps its energy friction holding it [1e-3]") {
  ImpactMaterial m = stone;
  m.young_modulus = 1e8;
  ImpactScene s = sphere_on_plane(m, 0.01, {});
  s.walls[0].shape = {WallKind::cylinder, {}, {0, 1, 0}, 0.05, {}, {}};
  s.particles[0].position = {0, 0, -0.04};
  const double v = 1;
  s.particles[0].velocity = {v, 0, 0};
  s.particles[0].spin = {0, -v / 0.01, 0};  // rolls on the bottom
  s.duration = 0.1;
  s.safety = 0.05;
  const ImpactResult r = run(s);
  CHECK(norm(r.particles[0].position) == doctest::Approx(0.04).epsilon(1e-2));
  CHECK(kinetic(m, 0.01, r.particles[0]) == doctest::Approx(r.kinetic_before).epsilon(2e-2));
}

TEST_CASE("impact: rolling friction brings a rolling sphere to rest none lets it roll on") {
  ImpactMaterial m = stone;
  m.young_modulus = 1e7, m.restitution = 0.3;
  const auto roll = [&](double rolling, RollingModel model) {
    m.rolling_friction = rolling;
    ImpactScene s = sphere_on_plane(m, 0.01, {0.1, 0, 0});
    s.materials[1].young_modulus = 1e7;
    s.particles[0].spin = {0, 10, 0};
    s.gravity = {0, 0, -9.81};
    s.rolling = model;
    s.duration = 0.3;
    s.safety = 0.02;
    return run(s).particles[0];
  };
  CHECK(roll(0, RollingModel::constant).velocity.x == doctest::Approx(0.1).epsilon(0.02));
  // torque mu_r m g r on a rolling sphere of 7/5 m r^2: a = 5/7 mu_r g
  const double slowed = 0.1 - 5.0 / 7 * 0.02 * 9.81 * 0.3;
  CHECK(roll(0.02, RollingModel::constant).velocity.x == doctest::Approx(slowed).epsilon(0.03));
  CHECK(roll(0.02, RollingModel::elastic_plastic).velocity.x == doctest::Approx(slowed).epsilon(0.1));
  CHECK(std::abs(roll(0.2, RollingModel::constant).velocity.x) < 1e-3);
}

TEST_CASE("impact: a cluster gives the same for any number of threads and keeps its momentum") {
  ImpactScene s;
  s.materials = {stone};
  s.materials[0].restitution = 0.5;
  for (int i = 0; i < 64; ++i) {
    const Vec3 x{0.0205 * (i % 4), 0.0205 * (i / 4 % 4), 0.0205 * (i / 16)};
    s.particles.push_back({x, (-20.0) * (x - Vec3{0.03, 0.031, 0.029}), {double(i), 1, -1}, 0.01, 0});
  }
  s.duration = 0.004;
  s.safety = 0.03;
  const ImpactResult one = run(s);
  s.threads = 3;
  const ImpactResult three = run(s);
  Vec3 before, after;
  for (std::size_t k = 0; k < 64; ++k) {
    CHECK(one.particles[k].velocity == three.particles[k].velocity);
    before += s.particles[k].velocity;
    after += one.particles[k].velocity;
  }
  CHECK(norm(after - before) < 1e-11);
  CHECK(one.kinetic_after < 0.9 * one.kinetic_before);
  CHECK(one.searches > 1);
}

TEST_CASE("impact: overlap a place behind a wall and a scene at rest are refused") {
  const auto complaint = [](const ImpactScene& s) -> std::string {
    try {
      ImpactResult r;
      run_impact(s, r);
    } catch (const BadInput& error) {
      return error.what();
    }
    return "accepted";
  };
  ImpactScene s = head_on(stone, 0.01, 1);
  CHECK(complaint(s) == "accepted");
  s.particles[0].position.x += 1e-5;
  CHECK(complaint(s).starts_with("particles 1 and 2 overlap by 1e-05 m"));
  s = sphere_on_plane(stone, 0.01, {0, 0, -1});
  s.walls[0].shape.direction = {0, 0, -1};
  CHECK(complaint(s).starts_with("particle 1 reaches 0.02 m into or beyond wall 1"));
  s = sphere_on_plane(stone, 0.01, {0, 0, -1});
  s.particles[0].velocity = {};
  CHECK(complaint(s).starts_with("nothing moves"));
}

TEST_CASE("impact: a sphere that is too soft for its speed breaks the run it does not tunnel") {
  ImpactMaterial m = stone;
  m.young_modulus = 1e5;
  ImpactScene s = sphere_on_plane(m, 0.01, {0, 0, -20});
  s.materials[1].young_modulus = 1e5;
  s.duration = 0.01;
  ImpactResult r;
  CHECK_THROWS_AS(run_impact(s, r), SimulationBroke);
  CHECK(!r.rows.empty());
}
