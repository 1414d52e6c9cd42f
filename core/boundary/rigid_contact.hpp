// What rigid bodies that press spheres share: how stiff they are met, and which spheres may touch
// before the next look.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "core/ranks/partition.hpp"
#include "core/tables/particle_table.hpp"

namespace breccia {

/// (B111): Pa, force over radius and depth: as a bond of two equal spheres, pi r^2 alpha E/(2 r).
inline double rigid_contact_stiffness(double young_modulus, double alpha) {
  return 0.5 * std::numbers::pi * alpha * young_modulus;
}

/// Steps between two lists of the spheres that may touch.
inline constexpr std::uint64_t list_every = 64;

/// The step at which a list that is made now is made anew.
inline std::uint64_t next_list_after(std::uint64_t step) { return step - step % list_every + list_every; }

/// Free rows that may touch a body before the next list, rising, the same on every rank.
/// @param speed  m/s, of the body, where spheres do not move with it
/// @param depth  depth(row): m, by which a sphere reaches into the body; negative when apart
template <class Depth>
std::vector<Row> rows_that_may_touch(const ParticleTable& p, const Partition& partition, double dt,
                                     int threads, double speed, const Depth& depth) {
  struct Fastest {
    double speed2 = 0;
    Fastest& operator+=(const Fastest& o) {
      speed2 = std::max(speed2, o.speed2);
      return *this;
    }
  };
  std::vector<Fastest> blocks;
  const Fastest most = sum_particles(partition, threads, blocks, [&](std::size_t row) {
    return Fastest{dot(p.velocity[row], p.velocity[row])};
  });
  // both may move, and speed up, before the list is made anew
  const double margin = 4.0 * static_cast<double>(list_every) * dt * (std::sqrt(most.speed2) + speed);
  std::vector<Row> mine;
  const Rows free = partition.owned(0, p.free);
  for (std::size_t row = free.first; row < free.last; ++row)
    if (depth(row) > -margin) mine.push_back(static_cast<Row>(row));
  if (partition.ranks.alone()) return mine;
  return gather_elements_everywhere(partition.ranks, std::span<const Row>(mine));
}

}  // namespace breccia
