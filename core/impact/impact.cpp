#include "core/impact/impact.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/base/error.hpp"
#include "core/impact/impact_world.hpp"
#include "kernels/loops/integrate.hpp"

namespace breccia {
namespace {

void check_step(ImpactWorld& w) {
  for (std::size_t row = 0; row < w.particles.size; ++row) {
    w.records[row].contact_time += w.touched[row] ? w.dt : 0.0;
    if (w.demand[row] > w.particles.mass[row])
      fail<SimulationBroke>(
          "step {}, {:.4g} s: particle {} has more or deeper contacts than a step of {:.3g} s allows; lower "
          "time.safety",
          w.step, w.time(), w.particles.gid[row], w.dt);
  }
  for (std::size_t k = 0; k < w.floating.size(); ++k)
    if (const ImpactWall& wall = w.scene.walls[k]; wall.load > 0.0 && w.floating[k].demand > wall.mass)
      fail<SimulationBroke>(
          "step {}, {:.4g} s: wall {} of {:.4g} kg is too light for the contacts on it and a step of {:.3g} "
          "s; "
          "give it a "
          "larger wall.mass or lower time.safety",
          w.step, w.time(), k + 1, wall.mass, w.dt);
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
  std::vector<WallLoad> mean = w.sums;
  for (WallLoad& load : mean) {
    load.force = (1.0 / static_cast<double>(w.summed)) * load.force;
    load.torque = (1.0 / static_cast<double>(w.summed)) * load.torque;
  }
  result.wall_rows.push_back(std::move(mean));
  w.sums.assign(w.sums.size(), {});
  w.summed = 0;
}

/// The forces of this instant, and what the walls take up of them.
void look(ImpactWorld& w) {
  find_forces(w);
  ++w.summed;
  for (std::size_t k = 0; k < w.loads.size(); ++k) {
    w.sums[k].force += w.loads[k].force;
    w.sums[k].torque += w.loads[k].torque;
    w.sums[k].work = w.loads[k].work;
  }
}

void integrate(ImpactWorld& w) {
  ParticleTable& p = w.particles;
  static const IntegrateFree integrate_free = integrate_free_for(best_instruction_set());
  integrate_free({p.position, p.velocity, p.spin, p.force, p.torque, p.mass, p.radius}, 0, p.size, w.dt, {},
                 false);
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
  std::size_t names = scene.wall_names.size();
  for (const ImpactWall& wall : scene.walls) {
    w.placed.push_back(wall.shape);
    names = std::max(names, wall.name + 1);
  }
  w.floating.resize(scene.walls.size());
  w.loads.resize(names);
  w.sums.resize(names);
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

void run_impact(const ImpactScene& scene, ImpactResult& result, const ImpactWatch& watch) {
  check_start(scene);
  result.critical_time_step = critical_impact_step(scene);
  const double steps = impact_steps(scene, result.critical_time_step);
  result.time_step = scene.duration / steps;
  ImpactWorld w = make_world(scene, result);
  const auto last = static_cast<std::uint64_t>(steps);
  const std::uint64_t every = std::max<std::uint64_t>(1, last / static_cast<std::uint64_t>(scene.rows));
  const auto start = std::chrono::steady_clock::now();
  look(w);
  result.kinetic_before = kinetic_now(w);
  int frames = 0;
  const auto show_if_due = [&] {
    if (!watch.frame || frames >= scene.frames) return;
    const double due = scene.frames > 1 ? scene.duration * frames / (scene.frames - 1) : scene.duration;
    if (w.time() >= due * (1.0 - 1e-12)) watch.frame(w.particles, frames++, w.time());
  };
  while (w.step < last && !result.interrupted) {
    check_step(w);
    if (w.step % every == 0) record(w, result);
    show_if_due();
    integrate(w);
    ++w.step;
    look(w);
    if (w.step % 256 == 0 && watch.interrupted) result.interrupted = watch.interrupted(w.time());
  }
  record(w, result);
  show_if_due();
  conclude(w, result);
  result.run_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace breccia
