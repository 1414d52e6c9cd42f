#include "core/boundary/tool.hpp"

#include <algorithm>
#include <cmath>

#include "core/boundary/rigid_contact.hpp"

namespace breccia {
namespace {

/// Where the tool and a sphere meet.
struct Touch {
  Vec3 normal;       ///< unit, from the tool to the centre
  double depth = 0;  ///< m, negative when apart
};

Touch touch_of(const Tool& tool, const Vec3& centre, double radius) {
  const auto [point, inside] = nearest_on_tool(tool, centre);
  const Vec3 away = inside ? point - centre : centre - point;
  const double distance = norm(away);
  // a centre on the face itself is pushed ahead
  const Vec3 normal = distance > 0.0 ? (1.0 / distance) * away : Vec3{1, 0, 0};
  return {normal, inside ? radius + distance : radius - distance};
}

/// (B119): normal spring, and friction that opposes the slip of the centre past the tool.
Vec3 force_on(const Tool& tool, const ParticleTable& p, Row row, double dt) {
  const double r = p.radius[row];
  const Touch touch = touch_of(tool, p.position[row], r);
  if (!(touch.depth > 0.0)) return {};
  const double pressed = tool.stiffness * r * std::min(touch.depth, r);
  Vec3 slip = p.velocity[row] - Vec3{tool.speed, 0, 0};
  slip -= dot(slip, touch.normal) * touch.normal;
  const double speed = norm(slip);
  // no more than a quarter of what stops the slip within a step: stable, and at rest nearly
  // sticking
  const double brake = speed > 0.0 ? std::min(tool.friction * pressed / speed, 0.25 * p.mass[row] / dt) : 0.0;
  return pressed * touch.normal - brake * slip;
}

}  // namespace

Tool make_tool(const Cutting& c, const Assembly& a, double young_modulus, double alpha) {
  Tool tool;
  if (!(c.depth > 0.0)) return tool;
  tool.enabled = true;
  tool.front = {-std::sin(c.rake), 0, std::cos(c.rake)};
  tool.flank = {-std::cos(c.clearance), 0, std::sin(c.clearance)};
  const double width = c.width > 0.0 ? c.width : a.body.depth;
  // across the whole block: spheres at its sides reach over its faces a little
  tool.half_width = c.width > 0.0 ? 0.5 * c.width : a.body.depth;
  tool.area = c.depth * width;
  tool.stiffness = rigid_contact_stiffness(young_modulus, alpha);
  tool.friction = c.friction;
  tool.tip_z = 0.5 * a.body.height - c.depth;
  // as near as it can stand without touching, by bisection
  double low = -2.0 * a.body.diameter, high = 0.0;
  for (int k = 0; k < 60; ++k) {
    tool.tip_x = 0.5 * (low + high);
    bool touches = false;
    for (std::size_t row = 0; row < a.particles.size && !touches; ++row)
      touches = touch_of(tool, a.particles.position[row], a.particles.radius[row]).depth > 0.0;
    (touches ? high : low) = tool.tip_x;
  }
  tool.tip_x = low;
  return tool;
}

NearestOnTool nearest_on_tool(const Tool& tool, const Vec3& place) {
  const Vec3 tip{tool.tip_x + tool.travel, 0, tool.tip_z}, from = place - tip;
  const double across = std::clamp(place.y, -tool.half_width, tool.half_width);
  const auto cross_y = [](const Vec3& a, const Vec3& b) { return a.x * b.z - a.z * b.x; };
  const double up = std::max(0.0, from.x * tool.front.x + from.z * tool.front.z),
               back = std::max(0.0, from.x * tool.flank.x + from.z * tool.flank.z);
  const Vec3 on_front = tip + up * tool.front, on_flank = tip + back * tool.flank;
  // front to flank is a turn to the left: inside is left of the one and right of the other
  if (cross_y(tool.front, from) >= 0.0 && cross_y(from, tool.flank) >= 0.0) {
    if (across == place.y) return {{on_front.x, across, on_front.z}, true};
    return {{place.x, across, place.z}};
  }
  const auto gap2 = [&](const Vec3& on) {
    return (place.x - on.x) * (place.x - on.x) + (place.z - on.z) * (place.z - on.z);
  };
  const Vec3& on = gap2(on_front) < gap2(on_flank) ? on_front : on_flank;
  return {{on.x, across, on.z}};
}

void press_tool(Tool& tool, ParticleTable& p, const Partition& partition, std::uint64_t step, double dt) {
  if (!tool.enabled) return;
  if (step >= tool.next_list) {
    tool.rows = rows_that_may_touch(p, partition, dt, 1, std::abs(tool.speed), [&](std::size_t row) {
      return touch_of(tool, p.position[row], p.radius[row]).depth;
    });
    tool.force.assign(tool.rows.size(), {});
    tool.next_list = next_list_after(step);
  }
  std::vector<Vec3> blocks;
  const Vec3 all =
      tool.rows.empty() ? Vec3{} : sum_listed(partition, tool.rows, 1, blocks, [&](std::size_t k) {
        const Row row = tool.rows[k];
        tool.force[k] = force_on(tool, p, row, dt);
        p.force[row] += tool.force[k];
        return tool.force[k];
      });
  tool.load = -1.0 * all;
  tool.travel += dt * tool.speed;
  tool.work -= dt * tool.speed * tool.load.x;
}

}  // namespace breccia
