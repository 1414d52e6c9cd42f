#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/geometry/cell_list.hpp"
#include "core/impact/contacts.hpp"

namespace breccia {

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
      if (gap < -std::max(round_off, p.overlap) * p.radius)
        throw BadScene(
            "particle.position", i,
            fmt::format("particle {} reaches {:.4g} m into or beyond wall {} at the start; move it "
                        "away, or turn the plane's normal",
                        i + 1, -gap, k + 1));
    }
  }
  for (const auto& [a, b] : near_pairs(position, radius, -round_off, 0.0, scene.threads)) {
    const double overlap = radius[a] + radius[b] - norm(position[b] - position[a]);
    const double part = std::min(scene.particles[a].overlap, scene.particles[b].overlap);
    if (overlap <= part * std::min(radius[a], radius[b])) continue;
    throw BadScene("particle.position", b,
                   fmt::format("particles {} and {} overlap by {:.4g} m at the start; move them apart", a + 1,
                               b + 1, overlap));
  }
}

namespace {

/// m/s, of a point of a moving wall within reach of the particles at the start.
double fastest_wall(const ImpactScene& scene) {
  std::vector<Vec3> position;
  std::vector<double> radius;
  for (const ImpactParticle& p : scene.particles) position.push_back(p.position), radius.push_back(p.radius);
  double fastest = 0.0;
  for (const ImpactWall& wall : scene.walls) {
    const WallMotion& m = wall.motion;
    if (m.moves())
      fastest = std::max(fastest, norm(m.velocity) + norm(m.spin) * reach_of(m, 0.0, position, radius));
  }
  return fastest;
}

}  // namespace

double critical_impact_step(const ImpactScene& scene) {
  const double fall = norm(scene.gravity) * scene.duration, walls = fastest_wall(scene);
  double fastest = walls, least = HUGE_VAL;
  std::vector<char> is_met(scene.materials.size(), 0);
  for (const ImpactParticle& p : scene.particles) {
    fastest = std::max(fastest, norm(p.velocity) + fall);
    is_met[p.material] = 1;
  }
  for (std::size_t i = 0; i < scene.particles.size(); ++i) {
    const double mass = mass_of(scene, scene.particles[i]), speed = norm(scene.particles[i].velocity) + fall;
    const auto ask = [&](const ImpactConstants& c, double reduced_mass, double approach, double load = 0.0) {
      if (!(approach > 0.0 || load > 0.0)) return;
      double overlap = 0.0;
      if (scene.law == ContactLaw::hertz_mindlin) {
        if (approach > 0.0) overlap = hertz_impact(c.normal, reduced_mass, approach).overlap;
        // one sphere may carry a lid alone, and for a moment twice its load and more
        overlap = std::max(overlap, std::pow(4.0 * load / c.normal, 2.0 / 3.0));
      }
      const ContactSlopes s = slopes_at(scene.law, c, overlap);
      const auto stable = [](double m, double k, double d) {  // dt^2 k/4 + dt d/2 = m
        return 4.0 * m / (d + std::sqrt(d * d + 4.0 * m * k));
      };
      least = std::min({least, stable(reduced_mass, s.normal, s.damping),
                        stable(reduced_mass / rolling_factor, s.tangential, s.tangential_damping)});
    };
    for (const ImpactWall& wall : scene.walls)
      ask(wall_constants(scene, i, wall.material), mass, speed + 2.0 * walls, wall.load);
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

}  // namespace breccia
