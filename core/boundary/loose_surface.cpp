#include "core/boundary/loose_surface.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace breccia {
namespace {

constexpr std::uint64_t look_every = 16;  // steps, at spheres that are not of the lateral surface

/// N, after which a sphere is no faster than `most`; nothing where it is not anyway.
std::optional<Vec3> braked(const ParticleTable& p, Row row, double most, double dt) {
  Vec3 before = p.velocity[row];
  if (row >= p.free) before.z = 0.0;  // the platen's
  const double per_time = p.mass[row] / dt;
  const Vec3 after = before + (1.0 / per_time) * p.force[row];
  const double speed = norm(after);
  if (!(speed > most)) return std::nullopt;
  return per_time * ((most / speed) * after - before);
}

/// Whether nothing acts on a sphere beside a force.
bool has_only(const ParticleTable& p, Row row, const Vec3& force) {
  const Vec3& f = p.force[row];
  return f.x == force.x && f.y == force.y && (row >= p.free || f.z == force.z);
}

}  // namespace

bool looks_at_all(const Confinement& c, std::uint64_t step) {
  return !c.rigid && c.pressure != 0.0 && step % look_every == 0;
}

void let_loose_drift(Confinement& c, ParticleTable& p, const Partition& partition,
                     const Surroundings& around) {
  c.flying.clear();
  c.brake.clear();
  if (c.rigid || c.pressure == 0.0) return;
  const double most = 0.1 * std::max(c.pressure, c.pressure_x) / around.impedance;  // m/s
  const auto is_held = [&](Row row) { return row >= p.free && around.rough; };
  for_owned_entries(partition, c.rows, [&](std::size_t k) {
    const Row row = c.rows[k];
    c.drifts[k] = !is_held(row) && has_only(p, row, c.force[k]);
    if (!c.drifts[k]) return;
    if (const auto force = braked(p, row, most, around.dt)) p.force[row] = c.force[k] = *force;
  });
  if (!looks_at_all(c, around.step)) return;
  const Rows mine = partition.owned();
  for (std::size_t at = mine.first; at < mine.last; ++at) {
    const Row row = static_cast<Row>(at);
    if (is_held(row) || !has_only(p, row, Vec3{})) continue;
    const auto force = braked(p, row, most, around.dt);
    if (!force) continue;
    p.force[row] = *force;
    c.flying.push_back(row);
    c.brake.push_back(*force);
  }
}

}  // namespace breccia
