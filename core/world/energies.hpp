// Energies of a world as it is, and how many of its bonds are broken: sums over all ranks.
#pragma once
#include "core/world/world.hpp"

namespace breccia {

struct BrokenCount {
  std::size_t tension = 0, shear = 0;
  BrokenCount& operator+=(const BrokenCount& o) {
    tension += o.tension, shear += o.shear;
    return *this;
  }
};
BrokenCount count_broken(const World& world);

/// Calls visit(bond) for those of bonds [first, last) that may be damaged: single precision knows
/// whole blocks that are not.
template <class Visit>
void for_damaged(const World& w, std::size_t first, std::size_t last, const Visit& visit) {
  for (std::size_t k = first; k < last;) {
    const std::size_t end = w.single.empty() ? last : std::min(last, (k / bond_block + 1) * bond_block);
    if (w.single.empty() || w.single.damaged[k / bond_block] != 0)
      for (std::size_t bond = k; bond < end; ++bond) visit(bond);
    k = end;
  }
}

/// J, of plain velocities, which belong to half a step ago.
double kinetic_energy(const World& world);

/// Spheres of the lateral surface that no intact bond holds; on every rank.
std::vector<Gid> loose_at_surface(const World& world);

/// J, the same of the particles that an intact bond holds.
double kinetic_energy_of_bonded(const World& world);

/// J, of bonds and contacts.
/// @param back  s, by which the positions are taken back along the velocities: the world's step
///              gives the moment of the last forces, and of the history
double stored_energy(const World& world, double back = 0.0);

}  // namespace breccia
