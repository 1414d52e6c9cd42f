#include "core/impact/impact.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/base/error.hpp"
#include "core/geometry/cell_list.hpp"
#include "core/impact/contacts.hpp"
#include "kernels/laws/linear_contact.hpp"
#include "kernels/laws/rolling_friction.hpp"
#include "kernels/loops/integrate.hpp"

namespace breccia {
namespace {

/// The contact that the curve follows: the one that closed first.
struct Followed {
  const ImpactContactTable* table = nullptr;
  Row row = 0, partner = 0;
};

/// Everything that a run moves.
struct ImpactWorld {
  const ImpactScene& scene;
  std::vector<ImpactRecord>& records;  ///< of each particle, row by row
  double dt = 0;                       ///< s
  std::uint64_t step = 0;
  ParticleTable particles{};
  ImpactSearch search{};
  ImpactContactTable pairs{}, walls{};
  std::vector<double> demand{};  ///< kg, of the step, per particle
  std::vector<char> touched{};   ///< per particle, in this step
  Followed followed{};
  ImpactRow now{};  ///< of the instant of the last forces

  double time() const { return static_cast<double>(step) * dt; }
};

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
  return linear_contact_force({t.normal[k], t.tangential[k] / t.normal[k], t.damping[k], t.friction[k]},
                              overlap, pair, memory.shear);
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

/// The force of one pressed contact onto both its ends.
void press(ImpactWorld& w, ImpactContactTable& t, std::size_t k, const Ends& ends, double overlap,
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
    const Wall& wall = w.scene.walls[w.walls.partner[other.contact]].shape;
    if (m == k || wall.kind != WallKind::triangle) continue;
    const double gap = norm(nearest_on_wall(wall, one.nearest.point).point - one.nearest.point);
    if (gap > 1e-9 * radius) continue;
    const bool same = other.nearest.on_rim && norm(other.nearest.point - one.nearest.point) <= 1e-9 * radius;
    if (same ? m < k : other.distance < one.distance) return true;
  }
  return false;
}

void wall_force(ImpactWorld& w, const Touch& touch) {
  const ParticleTable& p = w.particles;
  const Row i = w.walls.row[touch.contact];
  const Wall& wall = w.scene.walls[w.walls.partner[touch.contact]].shape;
  constexpr double whole_arm = 0.5;  // is the particle's: the wall is an end at the nearest point
  Pair<double> pair =
      relative_motion<true>(ends_of(end_of(p, i), End<double>{touch.nearest.point, {}, {}}), whole_arm, w.dt);
  const Vec3 before = p.position[i] - w.dt * p.velocity[i];
  const Vec3 l = nearest_on_wall(wall, before).point - before;  // the nearest point wanders along the wall
  pair.normal_before = (1.0 / norm(l)) * l;
  pair.turn_cosine = dot(pair.normal_before, pair.normal);
  press(w, w.walls, touch.contact,
        {i, 0, true, inertia(sphere_inertia_factor, p.mass[i], p.radius[i]), whole_arm},
        p.radius[i] - touch.distance, pair, rolling_spin(p.spin[i], {}, pair.normal));
}

void wall_forces(ImpactWorld& w) {
  const ParticleTable& p = w.particles;
  ImpactContactTable& t = w.walls;
  std::vector<Touch> touches;
  for (std::size_t first = 0, last = 0; first < t.size; first = last) {
    touches.clear();
    const Row row = t.row[first];
    for (; last < t.size && t.row[last] == row; ++last) {
      const NearestPoint nearest = nearest_on_wall(w.scene.walls[t.partner[last]].shape, p.position[row]);
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

void search_if_due(ImpactWorld& w) {
  if (rebuild_is_due(w.search, w.particles)) renew_contacts(w.search, w.scene, w.particles, w.pairs, w.walls);
}

void weigh(ImpactWorld& w) {
  for (std::size_t row = 0; row < w.particles.size; ++row)
    w.particles.force[row] += w.particles.mass[row] * w.scene.gravity;
}

void check_step(ImpactWorld& w) {
  for (std::size_t row = 0; row < w.particles.size; ++row) {
    w.records[row].contact_time += w.touched[row] ? w.dt : 0.0;
    if (w.demand[row] > w.particles.mass[row])
      fail<SimulationBroke>(
          "step {}, {:.4g} s: particle {} has more or deeper contacts than a step of {:.3g} s allows; lower "
          "time.safety",
          w.step, w.time(), w.particles.gid[row], w.dt);
  }
}

/// Forces at the positions of this instant.
void find_forces(ImpactWorld& w) {
  std::fill(w.demand.begin(), w.demand.end(), 0.0);
  std::fill(w.touched.begin(), w.touched.end(), char{0});
  w.now = {};
  w.now.time_s = w.time();
  search_if_due(w);
  weigh(w);
  pair_forces(w);
  wall_forces(w);
}

/// Velocity and spin at the instant of the positions: half a step on from where they are kept.
struct Rates {
  Vec3 velocity, spin;
};
Rates rates_now(const ImpactWorld& w, std::size_t row) {
  const ParticleTable& p = w.particles;
  return {p.velocity[row] + (0.5 * w.dt / p.mass[row]) * p.force[row],
          p.spin[row] +
              (0.5 * w.dt / inertia(sphere_inertia_factor, p.mass[row], p.radius[row])) * p.torque[row]};
}

double kinetic_now(const ImpactWorld& w) {
  double sum = 0.0;
  for (std::size_t row = 0; row < w.particles.size; ++row) {
    const Rates r = rates_now(w, row);
    const double m = w.particles.mass[row];
    sum += 0.5 * m * dot(r.velocity, r.velocity) +
           0.5 * inertia(sphere_inertia_factor, m, w.particles.radius[row]) * dot(r.spin, r.spin);
  }
  return sum;
}

void record(ImpactWorld& w, ImpactResult& result) {
  w.now.kinetic_J = kinetic_now(w);
  if (!std::isfinite(w.now.kinetic_J))
    fail<SimulationBroke>("step {}, {:.4g} s: the kinetic energy is not a number; lower time.safety", w.step,
                          w.time());
  result.rows.push_back(w.now);
}

void integrate(ImpactWorld& w) {
  ParticleTable& p = w.particles;
  static const IntegrateFree integrate_free = integrate_free_for(best_instruction_set());
  integrate_free({p.position, p.velocity, p.spin, p.force, p.torque, p.mass, p.radius}, 0, p.size, w.dt, {});
}

/// A scene at its start: velocities are set back half a step, through which gravity alone has
/// acted. (B40)
ImpactWorld make_world(const ImpactScene& scene, ImpactResult& result) {
  ImpactWorld w{scene, result.particles};
  w.dt = result.time_step;
  const std::size_t n = scene.particles.size();
  ParticleTable& p = w.particles;
  p.resize(n, Features{});
  p.free = n;
  w.demand.resize(n);
  w.touched.resize(n);
  w.records.resize(n);
  w.search.skin = scene.particles.front().radius;
  for (std::size_t row = 0; row < n; ++row) {
    const ImpactParticle& one = scene.particles[row];
    p.gid[row] = w.records[row].gid = row + 1;
    p.radius[row] = one.radius;
    p.mass[row] = mass_of(scene, one);
    p.position[row] = p.reference_position[row] = one.position;
    p.velocity[row] = one.velocity - (0.5 * w.dt) * scene.gravity;
    p.spin[row] = one.spin;
    w.search.skin = std::min(w.search.skin, one.radius);
  }
  w.search.skin *= 0.25;
  return w;
}

void conclude(const ImpactWorld& w, ImpactResult& result) {
  for (std::size_t row = 0; row < w.particles.size; ++row) {
    const Rates r = rates_now(w, row);
    ImpactRecord& one = w.records[row];
    one.position = w.particles.position[row];
    one.velocity = r.velocity;
    one.spin = r.spin;
  }
  result.steps = w.step;
  result.searches = w.search.rebuilds;
  result.time = w.time();
  result.kinetic_after = kinetic_now(w);
  result.open_contacts = static_cast<std::size_t>(w.now.contacts);
}

}  // namespace

void check_start(const ImpactScene& scene) {
  constexpr double round_off = 1e-9;  // of a radius: surfaces that just meet
  std::vector<Vec3> position;
  std::vector<double> radius;
  for (std::size_t i = 0; i < scene.particles.size(); ++i) {
    const ImpactParticle& p = scene.particles[i];
    position.push_back(p.position);
    radius.push_back(p.radius);
    for (std::size_t k = 0; k < scene.walls.size(); ++k) {
      const double gap = clearance(scene.walls[k].shape, p.position) - p.radius;
      if (gap < -round_off * p.radius)
        throw BadScene(
            "particle.position", i,
            fmt::format("particle {} reaches {:.4g} m into or beyond wall {} at the start; move it "
                        "away, or turn the plane's normal",
                        i + 1, -gap, k + 1));
    }
  }
  for (const auto& [a, b] : near_pairs(position, radius, -round_off, 0.0, scene.threads))
    throw BadScene("particle.position", b,
                   fmt::format("particles {} and {} overlap by {:.4g} m at the start; move them apart", a + 1,
                               b + 1, radius[a] + radius[b] - norm(position[b] - position[a])));
}

double critical_impact_step(const ImpactScene& scene) {
  const double fall = norm(scene.gravity) * scene.duration;
  double fastest = 0.0, least = HUGE_VAL;
  std::vector<char> is_met(scene.materials.size(), 0);
  for (const ImpactParticle& p : scene.particles) {
    fastest = std::max(fastest, norm(p.velocity) + fall);
    is_met[p.material] = 1;
  }
  for (std::size_t i = 0; i < scene.particles.size(); ++i) {
    const double mass = mass_of(scene, scene.particles[i]), speed = norm(scene.particles[i].velocity) + fall;
    const auto ask = [&](const ImpactConstants& c, double reduced_mass, double approach) {
      if (!(approach > 0.0)) return;
      const double overlap = scene.law == ContactLaw::hertz_mindlin
                                 ? hertz_impact(c.normal, reduced_mass, approach).overlap
                                 : 0.0;
      const ContactSlopes s = slopes_at(scene.law, c, overlap);
      const auto stable = [](double m, double k, double d) {  // dt^2 k/4 + dt d/2 = m
        return 4.0 * m / (d + std::sqrt(d * d + 4.0 * m * k));
      };
      least = std::min({least, stable(reduced_mass, s.normal, s.damping),
                        stable(reduced_mass / rolling_factor, s.tangential, s.tangential_damping)});
    };
    for (const ImpactWall& wall : scene.walls) ask(wall_constants(scene, i, wall.material), mass, speed);
    if (scene.particles.size() < 2) continue;
    // a partner that is flat but no heavier: stiffer than any, and the reduced mass is half of ours
    for (std::size_t m = 0; m < scene.materials.size(); ++m)
      if (is_met[m]) ask(wall_constants(scene, i, m), 0.5 * mass, speed + fastest);
  }
  if (!std::isfinite(least))
    throw BadScene(
        "particle.velocity", 0,
        "nothing moves: give a particle a velocity or set gravity, and another one or a wall to meet");
  return least;
}

double impact_steps(const ImpactScene& scene, double critical_step) {
  const double step = scene.safety * critical_step, steps = std::ceil(scene.duration / step);
  if (!(steps < 1e10))
    throw BadScene(
        "time.duration", 0,
        fmt::format("{:.3g} s would need {:.2g} steps of {:.3g} s; shorten it or raise time.safety",
                    scene.duration, steps, step));
  return steps;
}

void run_impact(const ImpactScene& scene, ImpactResult& result, const std::function<bool()>& interrupted) {
  check_start(scene);
  result.critical_time_step = critical_impact_step(scene);
  const double steps = impact_steps(scene, result.critical_time_step);
  result.time_step = scene.duration / steps;
  ImpactWorld w = make_world(scene, result);
  const auto last = static_cast<std::uint64_t>(steps);
  const std::uint64_t every = std::max<std::uint64_t>(1, last / static_cast<std::uint64_t>(scene.rows));
  const auto start = std::chrono::steady_clock::now();
  find_forces(w);
  result.kinetic_before = kinetic_now(w);
  while (w.step < last && !result.interrupted) {
    check_step(w);
    if (w.step % every == 0) record(w, result);
    integrate(w);
    ++w.step;
    find_forces(w);
    if (w.step % 256 == 0 && interrupted) result.interrupted = interrupted();
  }
  record(w, result);
  conclude(w, result);
  result.run_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace breccia
