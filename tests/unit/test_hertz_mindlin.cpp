#include <doctest/doctest.h>

#include <random>

#include "kernels/laws/hertz_mindlin.hpp"
#include "kernels/laws/restitution.hpp"
#include "kernels/laws/rolling_friction.hpp"
#include "kernels/math/wall.hpp"

using namespace breccia;

TEST_CASE(
    "restitution: damping and coefficient are inverse to each other [1e-12] exp(-2) at critical damping") {
  for (const double e : {0.01, 0.1, 0.13, 0.1353, 0.14, 0.2, 0.5, 0.9, 0.999, 1.0})
    CHECK(restitution_of_damping(damping_of_restitution(e)) == doctest::Approx(e).epsilon(1e-12));
  CHECK(restitution_of_damping(1.0) == doctest::Approx(std::exp(-2.0)).epsilon(1e-15));
  CHECK(restitution_of_damping(1.0 - 1e-9) ==
        doctest::Approx(restitution_of_damping(1.0 + 1e-9)).epsilon(1e-4));
  CHECK(restitution_of_damping(0.0) == 1.0);
  CHECK(damping_of_restitution(1.0) == 0.0);
  CHECK(damping_of_restitution_with_pull(1.0) == 0.0);
  CHECK(damping_of_restitution_with_pull(0.5) < damping_of_restitution(0.5) + 0.1);
}

TEST_CASE("hertz: moduli of equal spheres and of a sphere on a rigid plane") {
  const double r = 0.01, young = 48e9, nu = 0.2, mass = 2;
  const ElasticBody sphere{young, nu, 1 / r, 1 / mass};
  const HertzMindlin pair = hertz_mindlin(sphere, sphere, 0.5, 0.3);
  const double modulus = young / (2 * (1 - nu * nu)), shear = young / (2 * (1 + nu)) / (2 * (2 - nu));
  CHECK(pair.normal == doctest::Approx(4.0 / 3 * modulus * std::sqrt(r / 2)).epsilon(1e-14));
  CHECK(pair.tangential == doctest::Approx(8 * shear * std::sqrt(r / 2)).epsilon(1e-14));
  CHECK(pair.damping == doctest::Approx(2 * std::sqrt(5.0 / 6) * 0.5 * std::sqrt(mass / 2)).epsilon(1e-14));
  CHECK(pair.friction == 0.3);
  const HertzMindlin wall = hertz_mindlin(sphere, {1e30, 0.3, 0, 0}, 0, 0);
  CHECK(wall.normal == doctest::Approx(8.0 / 3 * modulus * std::sqrt(r)).epsilon(1e-12));
  // Mindlin: k_t/k_n = 2 (1 - nu)/(2 - nu) whatever the partner
  CHECK(pair.tangential / (1.5 * pair.normal) == doctest::Approx(2 * (1 - nu) / (2 - nu)).epsilon(1e-12));
}

TEST_CASE(
    "hertz: the force never pulls slides at mu times itself and gives back less as the overlap shrinks") {
  const HertzMindlin contact{1e9, 8e8, 0.3, 0.25};
  Pair<double> pair{};
  pair.normal = {1, 0, 0};
  ContactMemory memory;
  pair.slip = {0, 1e-3, 0};
  Vec3 f = hertz_mindlin_force(contact, HertzForm::dissipative, 1e-4, pair, 1e-7, memory);
  CHECK(f.x == doctest::Approx(-1e3).epsilon(1e-12));
  CHECK(f.y == doctest::Approx(250).epsilon(1e-12));
  pair.slip = {};
  memory.shear = {0, 10, 0};
  f = hertz_mindlin_force(contact, HertzForm::dissipative, 0.25e-4, pair, 1e-7, memory);
  CHECK(f.y == doctest::Approx(5).epsilon(1e-12));
  f = hertz_mindlin_force(contact, HertzForm::dissipative, 1e-4, pair, 1e-7, memory);
  CHECK(f.y == doctest::Approx(5).epsilon(1e-12));
  pair.rate = 1e6;
  CHECK(hertz_mindlin_force(contact, HertzForm::dissipative, 1e-4, pair, 1e-7, memory) == Vec3{});
  CHECK(hertz_mindlin_force(contact, HertzForm::classic, 1e-4, pair, 1e-7, memory).x > 0);
}

TEST_CASE("wall: no point of a triangle is nearer than the one found") {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto any = [&] { return Vec3{uniform(random), uniform(random), uniform(random)}; };
  for (int k = 0; k < 300; ++k) {
    const Vec3 a = any(), b = any(), c = any(), p = 2.0 * any();
    const NearestPoint found = nearest_on_triangle(a, b, c, p);
    const double distance = norm(found.point - p);
    double least = 1e9;
    constexpr int n = 60;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j)
        least = std::min(least, norm(a + (double(i) / n) * (b - a) + (double(j) / n) * (c - a) - p));
    CHECK(distance <= least + 1e-12);
    CHECK(distance > least - 0.05);
    const Vec3 normal = cross(b - a, c - a);
    CHECK(std::abs(dot(found.point - a, normal)) < 1e-12);
    if (!found.on_rim) CHECK(norm(cross(found.point - p, normal)) < 1e-9);
  }
}

TEST_CASE("wall: nearest points and clearance of a plane and a cylinder") {
  const Wall plane{WallKind::plane, {0, 0, 1}, {0, 0, 1}, 0, {}, {}};
  CHECK(nearest_on_wall(plane, {3, 4, 6}).point == Vec3{3, 4, 1});
  CHECK(clearance(plane, {3, 4, 6}) == 5);
  CHECK(clearance(plane, {3, 4, 0}) == -1);
  const Wall tube{WallKind::cylinder, {0, 7, 0}, {0, 1, 0}, 2, {}, {}};
  CHECK(norm(nearest_on_wall(tube, {0, 3, 1}).point - Vec3{0, 3, 2}) < 1e-15);
  CHECK(clearance(tube, {0, 3, 1}) == doctest::Approx(1));
  CHECK(clearance(tube, {0, 3, -5}) == doctest::Approx(-3));
  CHECK(norm(nearest_on_wall(tube, {0, 3, 0}).point - Vec3{0, 3, 0}) == doctest::Approx(2));
}

TEST_CASE("rolling friction: limited against the rolling and it stops without turning back") {
  const Vec3 rolling = rolling_spin({1, 2, 3}, {0, 0, 1}, {0, 0, 1});
  CHECK(rolling == Vec3{1, 2, 0});
  const Vec3 torque = constant_rolling_torque({3, 4, 0}, 10, 1, 1e-3);
  CHECK(norm(torque - Vec3{-6, -8, 0}) < 1e-12);
  CHECK(norm(constant_rolling_torque({3e-3, 4e-3, 0}, 10, 1, 1e-3) - Vec3{-3, -4, 0}) < 1e-12);
  CHECK(constant_rolling_torque({}, 10, 1, 1e-3) == Vec3{});
  const Vec3 spring = elastic_plastic_rolling_torque({}, {1, 0, 0}, 1e6, 1e-3, 1e6, 1e-3);
  CHECK(spring.x == doctest::Approx(-2.25 * 1e6 * 1e-6 * 1e-3).epsilon(1e-12));
  CHECK(elastic_plastic_rolling_torque({}, {1, 0, 0}, 1e6, 1e-3, 1.0, 1e3).x ==
        doctest::Approx(-1e-3).epsilon(1e-12));
}
