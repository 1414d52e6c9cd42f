#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/impact/impact_world.hpp"
#include "kernels/laws/rolling_friction.hpp"
#include "kernels/laws/surface_contact.hpp"
#include "kernels/loops/integrate.hpp"

namespace breccia {
namespace {

/// How one end or both ends of a contact take part: their rows, and the reduced moment of inertia
/// for rolling.
struct Ends {
  Row lo, hi;
  bool wall;
  double inertia;
  double arm_offset;  ///< the arm of lo is 1/2 + this of the distance
};

Vec3 law_force(const ImpactWorld& w, const ImpactContactTable& t, std::size_t k, double overlap,
               const Pair<double>& pair, ContactMemory& memory) {
  if (w.scene.law == ContactLaw::hertz_mindlin)
    return hertz_mindlin_force({t.normal[k], t.tangential[k], t.damping[k], t.friction[k]}, w.scene.form,
                               overlap, pair, w.dt, memory);
  memory.shear += t.tangential[k] * pair.slip;
  memory.overlap = overlap;
  return surface_force({t.normal[k], t.tangential[k] / t.normal[k], t.damping[k], t.friction[k]}, overlap,
                       pair, memory.shear);
}

Vec3 rolling_torque(const ImpactWorld& w, ImpactContactTable& t, std::size_t k, const Ends& ends,
                    const Vec3& rolling, double stiffness, double pressed) {
  if (!(t.lever[k] > 0.0) || !(pressed > 0.0)) return {};
  if (w.scene.rolling == RollingModel::constant)
    return constant_rolling_torque(rolling, t.lever[k] * pressed, ends.inertia, w.dt);
  return elastic_plastic_rolling_torque(t.rolling[k], rolling, stiffness, t.lever[k], pressed, w.dt);
}

void note(ImpactWorld& w, const ImpactContactTable& t, std::size_t k, const Ends& ends, double pressed) {
  const auto one = [&](Row row) {
    ImpactRecord& r = w.records[row];
    r.largest_overlap = std::max(r.largest_overlap, t.overlap[k]);
    r.largest_force = std::max(r.largest_force, pressed);
    w.touched[row] = 1;
    if (!(t.overlap[k] < 0.5 * w.particles.radius[row]))
      fail<SimulationBroke>(
          "step {}, {:.4g} s: particle {} overlaps by more than half its radius; the material is too soft "
          "for the "
          "speed, or time.safety too large",
          w.step, w.time(), w.particles.gid[row]);
  };
  one(ends.lo);
  if (!ends.wall) one(ends.hi);
  w.now.contacts += 1;
  Followed& f = w.followed;
  if (!f.table) f = {&t, t.row[k], t.partner[k]};
  if (f.table != &t || f.row != t.row[k] || f.partner != t.partner[k]) return;
  w.now.overlap_m = t.overlap[k];
  w.now.normal_force_N = pressed;
  w.now.tangential_force_N = norm(t.shear_force[k]);
}

/// The force of one pressed contact onto both its ends. @returns that on lo, N
Vec3 press(ImpactWorld& w, ImpactContactTable& t, std::size_t k, const Ends& ends, double overlap,
           const Pair<double>& pair, const Vec3& rolling) {
  ParticleTable& p = w.particles;
  ContactMemory memory{rotate_with_pair<true>(t.shear_force[k], pair), t.overlap[k]};
  const Vec3 force = law_force(w, t, k, overlap, pair, memory);
  const double pressed = -dot(force, pair.normal);
  t.shear_force[k] = memory.shear;
  t.overlap[k] = overlap;
  const ContactSlopes slopes = slopes_at(w.scene.law, {t.normal[k], t.tangential[k], t.damping[k]}, overlap);
  t.rolling[k] = rotate_with_pair<true>(t.rolling[k], pair);
  t.rolling[k] = rolling_torque(w, t, k, ends, rolling, slopes.normal, pressed);
  const Vec3 moment = pair.distance * cross(pair.normal, force);
  const double demand = step_demand(slopes, w.dt);
  p.force[ends.lo] += force;
  p.torque[ends.lo] += (0.5 + ends.arm_offset) * moment + t.rolling[k];
  w.demand[ends.lo] += ends.wall ? demand : 2.0 * demand;
  if (!ends.wall) {
    p.force[ends.hi] -= force;
    p.torque[ends.hi] += (0.5 - ends.arm_offset) * moment - t.rolling[k];
    w.demand[ends.hi] += 2.0 * demand;
  }
  note(w, t, k, ends, pressed);
  return force;
}

void part(ImpactContactTable& t, std::size_t k) {
  t.overlap[k] = 0.0;
  t.shear_force[k] = t.rolling[k] = {};
}

End<double> end_of(const ParticleTable& p, Row row) {
  return {p.position[row], p.velocity[row], p.spin[row]};
}

void pair_forces(ImpactWorld& w) {
  ParticleTable& p = w.particles;
  ImpactContactTable& t = w.pairs;
  for (std::size_t k = 0; k < t.size; ++k) {
    const Row i = t.row[k], j = t.partner[k];
    const Vec3 l = p.position[j] - p.position[i];
    const double touch = p.radius[i] + p.radius[j];
    if (!(dot(l, l) < touch * touch)) {
      part(t, k);
      continue;
    }
    const double arm_offset = 0.5 * (p.radius[i] - p.radius[j]) / touch;
    const Pair<double> pair = relative_motion<true>(ends_of(end_of(p, i), end_of(p, j)), arm_offset, w.dt);
    const double one = inertia(sphere_inertia_factor, p.mass[i], p.radius[i]),
                 other = inertia(sphere_inertia_factor, p.mass[j], p.radius[j]);
    press(w, t, k, {i, j, false, one * other / (one + other), arm_offset}, touch - pair.distance, pair,
          rolling_spin(p.spin[i], p.spin[j], pair.normal));
  }
}

/// A wall that a particle touches.
struct Touch {
  std::size_t contact;
  NearestPoint nearest;
  double distance;
};

/// (B39): an edge that two triangles share is met once: a touch on a rim is dropped when its point
/// lies on another triangle that is touched as near or nearer.
bool is_doubled(const ImpactWorld& w, const std::vector<Touch>& touches, std::size_t k, double radius) {
  if (!touches[k].nearest.on_rim) return false;
  for (std::size_t m = 0; m < touches.size(); ++m) {
    const Touch &one = touches[k], &other = touches[m];
    const Wall& wall = w.placed[w.walls.partner[other.contact]];
    if (m == k || wall.kind != WallKind::triangle) continue;
    const double gap = norm(nearest_on_wall(wall, one.nearest.point).point - one.nearest.point);
    if (gap > 1e-9 * radius) continue;
    const bool same = other.nearest.on_rim && norm(other.nearest.point - one.nearest.point) <= 1e-9 * radius;
    if (same ? m < k : other.distance < one.distance) return true;
  }
  return false;
}

/// m/s, of the point of a wall that is at `place`.
Vec3 wall_velocity(const ImpactWorld& w, std::size_t number, const Vec3& place) {
  return velocity_at(w.scene.walls[number].motion, w.time(), place) +
         w.floating[number].speed * w.placed[number].direction;
}

/// What a wall takes up, and the work it does.
void load_wall(ImpactWorld& w, std::size_t number, const Vec3& place, const Vec3& on_particle,
               const Vec3& rolling) {
  const ImpactWall& wall = w.scene.walls[number];
  WallLoad& load = w.loads[wall.name];
  const Vec3 velocity = wall_velocity(w, number, place);
  w.floating[number].pressed += dot(on_particle, w.placed[number].direction);
  load.force -= on_particle;
  load.torque -= cross(place - centre_at(wall.motion, w.time()), on_particle) + rolling;
  load.work += w.dt * (dot(on_particle, velocity) + dot(rolling, spin_at(wall.motion, w.time())));
}

void wall_force(ImpactWorld& w, const Touch& touch) {
  const ParticleTable& p = w.particles;
  const Row i = w.walls.row[touch.contact], number = w.walls.partner[touch.contact];
  const ImpactWall& wall = w.scene.walls[number];
  const Vec3 place = touch.nearest.point;
  constexpr double whole_arm = 0.5;  // is the particle's: the wall is an end at the nearest point
  const End<double> end{place, wall_velocity(w, number, place), {}};
  Pair<double> pair = relative_motion<true>(ends_of(end_of(p, i), end), whole_arm, w.dt);
  const Vec3 before = p.position[i] - w.dt * p.velocity[i];
  // the nearest point wanders along the wall
  const Vec3 l = nearest_on_wall(w.placed_before[number], before).point - before;
  pair.normal_before = (1.0 / norm(l)) * l;
  pair.turn_cosine = dot(pair.normal_before, pair.normal);
  const Vec3 spin = spin_at(wall.motion, w.time());
  const Vec3 force = press(w, w.walls, touch.contact,
                           {i, 0, true, inertia(sphere_inertia_factor, p.mass[i], p.radius[i]), whole_arm},
                           p.radius[i] - touch.distance, pair, rolling_spin(p.spin[i], spin, pair.normal));
  load_wall(w, number, place, force, w.walls.rolling[touch.contact]);
  w.floating[number].demand += step_demand(
      slopes_at(
          w.scene.law,
          {w.walls.normal[touch.contact], w.walls.tangential[touch.contact], w.walls.damping[touch.contact]},
          w.walls.overlap[touch.contact]),
      w.dt);
}

void wall_forces(ImpactWorld& w) {
  const ParticleTable& p = w.particles;
  ImpactContactTable& t = w.walls;
  std::vector<Touch> touches;
  for (std::size_t first = 0, last = 0; first < t.size; first = last) {
    touches.clear();
    const Row row = t.row[first];
    for (; last < t.size && t.row[last] == row; ++last) {
      const NearestPoint nearest = nearest_on_wall(w.placed[t.partner[last]], p.position[row]);
      const double distance = norm(nearest.point - p.position[row]);
      if (distance < p.radius[row])
        touches.push_back({last, nearest, distance});
      else
        part(t, last);
    }
    for (std::size_t k = 0; k < touches.size(); ++k) {
      if (is_doubled(w, touches, k, p.radius[row]))
        part(t, touches[k].contact);
      else
        wall_force(w, touches[k]);
    }
  }
}

/// Brings the walls to where they are at this instant.
void move_walls(ImpactWorld& w) {
  w.placed_before = w.placed;
  double fastest = 0.0;
  for (std::size_t k = 0; k < w.placed.size(); ++k) {
    const ImpactWall& wall = w.scene.walls[k];
    if (wall.motion.moves() || wall.load > 0.0) w.placed[k] = placed(wall.shape, wall.motion, w.time());
    Floating& f = w.floating[k];
    if (wall.load > 0.0 && w.step > 0) {
      f.speed += w.dt * (wall.load - f.pressed) / wall.mass;
      f.offset += w.dt * f.speed;
      fastest = std::max(fastest, std::abs(f.speed));
      if (!(std::abs(f.speed) * w.dt < w.search.skin))
        fail<SimulationBroke>(
            "step {}, {:.4g} s: wall {} of {:.4g} kg is too light for its load and a step of {:.3g} s: it "
            "moves at "
            "{:.3g} m/s; give it a larger wall.mass or lower time.safety",
            w.step, w.time(), k + 1, wall.mass, w.dt, f.speed);
    }
    f.pressed = f.demand = 0.0;
    w.placed[k].point += f.offset * w.placed[k].direction;
  }
  w.search.walls_moved += (w.search.wall_speed + fastest) * w.dt;
  for (WallLoad& load : w.loads) load.force = load.torque = {};
}

void search_if_due(ImpactWorld& w) {
  if (rebuild_is_due(w.search, w.particles))
    renew_contacts(w.search, w.scene, w.placed, w.time(), w.particles, w.pairs, w.walls);
}

void weigh(ImpactWorld& w) {
  for (std::size_t row = 0; row < w.particles.size; ++row)
    w.particles.force[row] += w.particles.mass[row] * w.scene.gravity;
}

}  // namespace

void find_forces(ImpactWorld& w) {
  std::fill(w.demand.begin(), w.demand.end(), 0.0);
  std::fill(w.touched.begin(), w.touched.end(), char{0});
  w.now = {};
  w.now.time_s = w.time();
  move_walls(w);
  search_if_due(w);
  weigh(w);
  pair_forces(w);
  wall_forces(w);
}

}  // namespace breccia
