#include "core/world/crack_record.hpp"

#include <algorithm>

#include "core/tables/laws.hpp"
#include "core/world/energies.hpp"
#include "kernels/loops/bond_energy.hpp"

namespace breccia {

CrackRecord make_crack_record(bool enabled, int ranges, std::size_t bonds) {
  CrackRecord record;
  record.enabled = enabled;
  if (!enabled) return record;
  const std::size_t room = 256 + bonds / 16 / static_cast<std::size_t>(ranges);
  record.room.assign(static_cast<std::size_t>(ranges), std::vector<BreakEvent>(room));
  for (auto& range : record.room) record.notes.push_back({range, 0});
  return record;
}

BreakNotes* notes_of(CrackRecord& record, int range) {
  return record.enabled ? &record.notes[static_cast<std::size_t>(range)] : nullptr;
}

namespace {

template <class Law>
Crack crack_of(const Law& law, bool coupled, const BreakEvent& was, double dt, const ParticleTable& p,
               const BondTable& b) {
  const std::size_t k = was.bond;
  const Vec3 l = p.position[b.row_hi[k]] - p.position[b.row_lo[k]];
  const Vec3 dv = p.velocity[b.row_hi[k]] - p.velocity[b.row_lo[k]];
  const double distance = norm(l), distance_before = norm(l - dt * dv);
  const BondConstants<double> bond = constants_of_bond(b, k);
  const BondHistory<double> before{was.shear, was.plastic_stretch, was.damage_normal, was.damage_shear};
  const BondForce<double> carried = force_of_state(law, bond, before, distance_before, coupled);
  Crack crack;
  crack.gid_lo = b.gid_lo[k];
  crack.gid_hi = b.gid_hi[k];
  crack.position = p.position[b.row_lo[k]] + 0.5 * l;
  crack.normal = (1.0 / distance) * l;
  crack.mode = bond_state(b, k);
  crack.normal_force = carried.normal;
  crack.shear_force = norm(carried.shear);
  crack.area = bond.strength_area;
  // (B88)
  crack.energy = stored_energy(law, bond, before, distance_before, coupled) -
                 stored_energy(law, bond, history_of_bond(b, k), distance, coupled);
  return crack;
}

}  // namespace

void record_cracks(CrackRecord& record, std::span<const BondLaw> laws, bool coupled, double time, double dt,
                   const ParticleTable& p, const BondTable& b) {
  for (BreakNotes& notes : record.notes) {
    if (notes.count == 0) continue;
    const std::size_t noted = std::min(notes.count, notes.room.size());
    record.missed += notes.count - noted;
    // of several ranks the bonds that need nothing from elsewhere come first
    std::ranges::sort(notes.room.first(noted), {}, &BreakEvent::bond);
    for (const BreakEvent& was : notes.room.first(noted)) {
      record.cracks.push_back(with_laws(laws, b.law, [&](const auto& law_of) {
        return crack_of(law_of(was.bond), coupled, was, dt, p, b);
      }));
      record.cracks.back().time = time;
    }
    notes.count = 0;
  }
}

}  // namespace breccia
