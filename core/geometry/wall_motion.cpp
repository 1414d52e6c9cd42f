#include "core/geometry/wall_motion.hpp"

#include <cmath>

namespace breccia {
namespace {

/// s, of motion until then.
double moved_for(const WallMotion& m, double time) {
  return std::max(0.0, std::min(time, m.stop) - std::min(m.start, m.stop));
}

bool is_moving(const WallMotion& m, double time) { return time >= m.start && time < m.stop; }

Vec3 turned(const Vec3& v, const Vec3& axis, double angle) {
  return std::cos(angle) * v + std::sin(angle) * cross(axis, v) +
         ((1.0 - std::cos(angle)) * dot(axis, v)) * axis;
}

bool parallel(const Vec3& a, const Vec3& b) {
  const Vec3 c = cross(a, b);
  return dot(c, c) <= 1e-24 * dot(a, a) * dot(b, b);
}

bool is_carried_onto_itself(const Wall& wall, const WallMotion& m) {
  if (wall.kind == WallKind::plane)
    return std::abs(dot(m.velocity, wall.direction)) <= 1e-12 * norm(m.velocity) &&
           parallel(m.spin, wall.direction);
  if (wall.kind != WallKind::cylinder) return false;
  const bool turns = dot(m.spin, m.spin) > 0.0;
  const Vec3 off = m.centre - wall.point, aside = off - dot(off, wall.direction) * wall.direction;
  return parallel(m.velocity, wall.direction) &&
         (!turns || (parallel(m.spin, wall.direction) && norm(aside) <= 1e-9 * wall.radius));
}

}  // namespace

Vec3 centre_at(const WallMotion& m, double time) { return m.centre + moved_for(m, time) * m.velocity; }

Wall placed(const Wall& wall, const WallMotion& m, double time) {
  const double duration = moved_for(m, time), rate = norm(m.spin);
  if (!(duration > 0.0)) return wall;
  const Vec3 axis = rate > 0.0 ? (1.0 / rate) * m.spin : Vec3{}, centre = centre_at(m, time);
  const auto turn = [&](const Vec3& v) { return rate > 0.0 ? turned(v, axis, rate * duration) : v; };
  const auto carry = [&](const Vec3& place) { return centre + turn(place - m.centre); };
  Wall now = wall;
  now.point = carry(wall.point);
  now.second = carry(wall.second);
  now.third = carry(wall.third);
  now.direction = turn(wall.direction);
  return now;
}

Vec3 velocity_at(const WallMotion& m, double time, const Vec3& place) {
  if (!is_moving(m, time)) return {};
  return m.velocity + cross(m.spin, place - centre_at(m, time));
}

Vec3 spin_at(const WallMotion& m, double time) { return is_moving(m, time) ? m.spin : Vec3{}; }

double surface_speed(const Wall& wall, const WallMotion& m, double reach) {
  return is_carried_onto_itself(wall, m) ? 0.0 : norm(m.velocity) + reach * norm(m.spin);
}

}  // namespace breccia
