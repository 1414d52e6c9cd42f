// The tool that cuts: where it is, and what it does to a sphere (docs/model.md, B119).
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "core/boundary/tool.hpp"
#include "tests/scene.hpp"

using namespace breccia;

namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// A wedge whose tip is the origin.
Tool wedge(double rake, double clearance, double half_width = 1.0) {
  Tool t;
  t.enabled = true;
  t.front = {-std::sin(rake * degree), 0, std::cos(rake * degree)};
  t.flank = {-std::cos(clearance * degree), 0, std::sin(clearance * degree)};
  t.half_width = half_width;
  return t;
}

/// One free sphere before a wedge.
struct Meeting {
  ParticleTable p;
  Tool tool = wedge(0, 10);
  static constexpr double radius = 0.01, mass = 0.1, dt = 1e-6;

  explicit Meeting(const Vec3& x, const Vec3& v = {}) {
    p.resize(1, Features{});
    p.free = 1;
    p.radius[0] = radius, p.mass[0] = mass, p.position[0] = x, p.velocity[0] = v;
    tool.stiffness = 1e9;
  }
  Vec3 force() {
    p.force[0] = {};
    press_tool(tool, p, serial_partition(1), 0, dt);
    return p.force[0];
  }
};

bool near(const Vec3& a, const Vec3& b) { return norm(a - b) < 1e-12 * (1.0 + norm(b)); }

}  // namespace

TEST_CASE("tool: the nearest point is on the face, the flank, the tip or a side [closed form, 1e-12]") {
  const Tool upright = wedge(0, 10);
  CHECK(near(nearest_on_tool(upright, {0.3, 0.2, 0.5}).point, {0, 0.2, 0.5}));    // ahead of the face
  CHECK(near(nearest_on_tool(upright, {0.3, 0, -0.4}).point, {0, 0, 0}));         // below, ahead: the tip
  CHECK(near(nearest_on_tool(upright, {0, 1.5, 0.5}).point, {0, 1, 0.5}));        // beside
  CHECK(near(nearest_on_tool(upright, {-0.3, 1.5, 0.5}).point, {-0.3, 1, 0.5}));  // beside its inside
  CHECK_FALSE(nearest_on_tool(upright, {-0.3, 1.5, 0.5}).inside);
  const NearestOnTool within = nearest_on_tool(upright, {-0.3, 0, 0.5});
  CHECK(within.inside);
  CHECK(near(within.point, {0, 0, 0.5}));  // pushed ahead, not up
  const double c = std::cos(10 * degree), s = std::sin(10 * degree);
  const Vec3 below = Vec3{-2 * c, 0, 2 * s} - 0.5 * Vec3{s, 0, c};  // half a metre off the flank
  CHECK(near(nearest_on_tool(upright, below).point, {-2 * c, 0, 2 * s}));
  const Tool leaning = wedge(30, 0);
  const Vec3 on{-std::sin(30 * degree), 0, std::cos(30 * degree)}, ahead = on + 0.2 * Vec3{on.z, 0, -on.x};
  CHECK(near(nearest_on_tool(leaning, ahead).point, on));
  Tool gone = upright;
  gone.travel = 0.1, gone.tip_x = 0.05, gone.tip_z = -0.2;
  CHECK(near(nearest_on_tool(gone, {1, 0, 0}).point, {0.15, 0, 0}));
}

TEST_CASE(
    "tool: spring, Coulomb friction, and no more of it than stops a sphere [(B119), closed form, 1e-12]") {
  Meeting m({0.009, 0, 0.5});
  CHECK(near(m.force(), {1e9 * 0.01 * 0.001, 0, 0}));
  CHECK(near(m.tool.load, {-1e4, 0, 0}));
  m.tool.next_list = 0, m.tool.friction = 0.3;
  m.p.velocity[0] = {5, 0, 2};  // along the face
  CHECK(near(m.force(), {1e4, 0, -3e3}));
  m.tool.next_list = 0;
  m.p.velocity[0] = {0, 1e-3, 0};
  CHECK(near(m.force(), {1e4, -0.25 * 0.1 / 1e-6 * 1e-3, 0}));
  // in by more than its radius: no harder than by its radius
  Meeting deep({-0.02, 0, 0.5});
  CHECK(near(deep.force(), {1e9 * 0.01 * 0.01, 0, 0}));
  Meeting apart({0.0101, 0, 0.5});
  CHECK(near(apart.force(), {}));
}

TEST_CASE("tool: it goes on, and its work is force times way") {
  Meeting m({0.009, 0, 0.5});
  m.tool.speed = 2;
  m.force();
  CHECK(m.tool.travel == doctest::Approx(2e-6));
  CHECK(m.tool.work == doctest::Approx(1e4 * 2e-6));
}
