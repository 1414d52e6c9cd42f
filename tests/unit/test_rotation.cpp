// Rotation vectors against closed forms.
#include <doctest/doctest.h>

#include <numbers>

#include "core/stepping/step.hpp"
#include "kernels/math/rotation.hpp"
#include "tests/scene.hpp"

using namespace breccia;

namespace {

/// Rodrigues' formula.
Vec3 turned(const Vec3& x, const Vec3& rotation) {
  const double angle = norm(rotation);
  if (angle == 0) return x;
  const Vec3 n = (1 / angle) * rotation;
  return std::cos(angle) * x + std::sin(angle) * cross(n, x) + ((1 - std::cos(angle)) * dot(n, x)) * n;
}

}  // namespace

TEST_CASE("rotation: one after the other turns a vector as both do in turn [Rodrigues, 1e-14]") {
  const Vec3 x{0.3, -1.2, 0.8};
  for (const Vec3& first : {Vec3{}, {1e-12, 0, 0}, {0.4, -0.2, 1.1}, {2, 2, -1}})
    for (const Vec3& then : {Vec3{}, {0, 1e-9, 0}, {-0.4, 0.2, -1.1}, {0.1, 3, 0.2}})
      CHECK(norm(turned(x, followed_by(first, then)) - turned(turned(x, first), then)) < 1e-14);
  // round and round about one axis: the angle stays up to pi
  Vec3 r;
  for (int k = 0; k < 1000; ++k) r = followed_by(r, {0, 0, 0.01});
  CHECK(r.z == doctest::Approx(10 - 4 * std::numbers::pi).epsilon(1e-11));
}

TEST_CASE("orientation: a sphere that spins evenly has turned by w t [1e-12], and none is kept unasked") {
  reference::Parameters p;
  WorldOptions o = scene::options(p);
  o.global_damping = {0, 0};
  for (const bool asked : {true, false}) {
    o.orientation = asked;
    World w = make_world(
        scene::free_body(
            {{1, 0.01, {0, 0, 0}, 0, {}, {30, 40, 0}}, {2, 0.01, {0.1, 0, 0}}, {3, 0.01, {0.12, 0, 0}}},
            p.beta, o.features),
        scene::material_of(p), scene::factor(p), o);
    w.dt = 1e-6;
    for (int step = 0; step < 20000; ++step) advance(w);
    REQUIRE(w.particles.orientation.empty() == !asked);
    if (asked) CHECK(norm(w.particles.orientation[0] - Vec3{0.6, 0.8, 0}) < 1e-12);
  }
}
