#include "core/boundary/release.hpp"

#include <cmath>

namespace breccia {
namespace {

constexpr std::uint64_t look_every = 16;  // steps

}  // namespace

void release_unheld(Confinement& c, const ParticleTable& p, const Partition& partition, std::uint64_t step,
                    double dt) {
  if (c.rigid || c.pressure == 0.0 || step % look_every != 0) return;
  for_owned_entries(partition, c.rows, [&](std::size_t k) {
    double& alone = c.alone[k];
    if (alone == released) return;
    const Row row = c.rows[k];
    const double push = norm(c.force[k]);
    if (row >= p.free || !(push > 0.0) || !(p.force[row] == c.force[k])) {
      alone = 0.0;  // something else acts on it, a platen holds it, or nothing presses
      return;
    }
    alone += static_cast<double>(look_every) * dt;
    if (0.5 * push / p.mass[row] * alone * alone > p.radius[row]) alone = released;
  });
}

std::vector<Gid> unheld(const Confinement& c, const ParticleTable& p, const Partition& partition) {
  std::vector<Gid> mine;
  for_owned_entries(partition, c.rows, [&](std::size_t k) {
    if (c.alone[k] != 0.0) mine.push_back(p.gid[c.rows[k]]);
  });
  if (partition.ranks.alone()) return mine;
  return gather_elements_everywhere(partition.ranks, std::span<const Gid>(mine));
}

std::vector<double> gather_unheld(const Confinement& c, const Partition& partition) {
  return gather_owned_entries<double>(partition, c.rows, c.alone);
}

}  // namespace breccia
