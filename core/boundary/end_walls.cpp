#include "core/boundary/end_walls.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/boundary/rigid_contact.hpp"

namespace breccia {
namespace {

struct Pushes {
  std::array<double, 2> force{};
  Pushes& operator+=(const Pushes& o) {
    force[0] += o.force[0], force[1] += o.force[1];
    return *this;
  }
};

/// m, by which a sphere reaches beyond a plane.
double depth(const EndWalls& walls, const Platens& platens, const ParticleTable& p, std::size_t row,
             std::size_t end) {
  if (walls.half_width > 0.0 && std::abs(p.position[row].x) > walls.half_width) return -p.radius[row];
  const double outward = end == 0 ? -1.0 : 1.0;
  const double plane = walls.place[end] + platens.travel[end].z;
  return outward * (p.position[row].z - plane) + p.radius[row];
}

}  // namespace

EndWalls make_end_walls(const Assembly& a, double young_modulus, double alpha) {
  EndWalls walls;
  walls.enabled = (a.grip == Support::ends && a.particles.free < a.particles.size) || a.planes;
  if (a.planes) walls.half_width = 0.5 * a.strip_width;
  walls.stiffness = rigid_contact_stiffness(young_modulus, alpha);
  constexpr double far = std::numeric_limits<double>::infinity();
  walls.place = {far, -far};
  for (std::size_t row = 0; row < a.particles.size; ++row) {
    if (a.planes && std::abs(a.particles.position[row].x) > walls.half_width) continue;
    const double z = a.particles.position[row].z, r = a.particles.radius[row];
    walls.place = {std::min(walls.place[0], z - r), std::max(walls.place[1], z + r)};
  }
  return walls;
}

void push_back(EndWalls& walls, const Platens& platens, ParticleTable& p, const Partition& partition,
               std::uint64_t step, double dt, int threads) {
  if (!walls.enabled) return;
  if (step >= walls.next_list) {
    // the speed of planes, which move with the held layers, is among those of spheres
    walls.rows = rows_that_may_touch(p, partition, dt, threads, 0.0, [&](std::size_t row) {
      return std::max(depth(walls, platens, p, row, 0), depth(walls, platens, p, row, 1));
    });
    walls.force.assign(walls.rows.size(), 0.0);
    walls.next_list = next_list_after(step);
  }
  walls.push = {};
  if (walls.rows.empty()) return;
  std::vector<Pushes> blocks;
  const Pushes all = sum_listed(partition, walls.rows, 1, blocks, [&](std::size_t k) {
    const Row row = walls.rows[k];
    Pushes one;
    for (const std::size_t end : {0u, 1u}) {
      // no further than a radius: what has passed a plane is not shot back
      const double r = p.radius[row], d = std::min(depth(walls, platens, p, row, end), r);
      if (d > 0.0) one.force[end] = (end == 0 ? 1.0 : -1.0) * walls.stiffness * r * d;
    }
    walls.force[k] = one.force[0] + one.force[1];
    p.force[row].z += walls.force[k];
    return one;
  });
  walls.push = all.force;
}

}  // namespace breccia
