#include "core/distributed/halo.hpp"

#include "core/ranks/pairs_of_rank.hpp"
#include "core/world/single_precision.hpp"

namespace breccia {
namespace {

std::size_t numbers_of_row(const ParticleTable& p) { return p.spin.empty() ? 6 : 9; }

}  // namespace

void build_halo(World& w) {
  Partition& s = w.partition;
  std::vector<std::vector<Row>> wanted(static_cast<std::size_t>(s.ranks.count));
  add_foreign_ends(s, w.bonds, wanted);
  add_foreign_ends(s, w.contacts, wanted);
  s.neighbours.clear();
  for (int rank = 0; rank < s.ranks.count; ++rank) {
    if (rank == s.ranks.rank) continue;
    std::vector<Row>& rows = wanted[static_cast<std::size_t>(rank)];
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    s.neighbours.push_back({rank, {}, std::move(rows), {}, {}});
  }
  exchange_send_lists(s.ranks, s.neighbours);
  for (Neighbour& n : s.neighbours) {
    n.outgoing.resize(n.send.size() * numbers_of_row(w.particles));
    n.incoming.resize(n.receive.size() * numbers_of_row(w.particles));
  }
}

void start_halo_exchange(World& w) {
  std::vector<Neighbour>& neighbours = w.partition.neighbours;
  if (neighbours.empty()) return;
  const Lap lap(w.phases, Phase::halo);
  const ParticleTable& p = w.particles;
  const bool spins = !p.spin.empty();
  for (Neighbour& n : neighbours) {
    double* to = n.outgoing.data();
    for (const Row row : n.send) {
      for (const Vec3* v : {&p.position[row], &p.velocity[row]}) *to++ = v->x, *to++ = v->y, *to++ = v->z;
      if (spins) *to++ = p.spin[row].x, *to++ = p.spin[row].y, *to++ = p.spin[row].z;
    }
  }
  begin_exchange(neighbours);
}

void finish_halo_exchange(World& w) {
  if (w.partition.neighbours.empty()) return;
  const Lap lap(w.phases, Phase::halo);
  if (!finish_exchange()) return;
  ParticleTable& p = w.particles;
  const bool spins = !p.spin.empty();
  for (Neighbour& n : w.partition.neighbours) {
    const double* from = n.incoming.data();
    const auto next = [&] {
      from += 3;
      return Vec3{from[-3], from[-2], from[-1]};
    };
    for (const Row row : n.receive) {
      p.position[row] = next();
      p.velocity[row] = next();
      if (spins) p.spin[row] = next();
      p.force[row] = {};  // what the loops have added here belongs to nobody
      if (spins) p.torque[row] = {};
    }
  }
  record_ghosts(w);
}

}  // namespace breccia
