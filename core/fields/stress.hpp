// Stress from the forces of bonds and contacts: of each particle, of the whole specimen, and how
// near each bond is to failure.
#pragma once
#include "core/world/world.hpp"

namespace breccia {

/// Symmetric tensor, Pa, tension positive.
struct Stress {
  Vec3 normal;  ///< xx, yy, zz
  Vec3 shear;   ///< yz, zx, xy
};

/// Mean stress of the volume (S5.19): (1/V) sum F (x) l over bonds and contacts, F on lo, l from lo
/// to hi. (S5.19); Bagi, Mech. Mater. 22 (1996) 165-177.
Stress mean_stress_tensor(const World& world);

/// Pa, (B106): of the pressure on the lateral surface what bonds and contacts hold up: the pressure
/// that acts, less the part of it that pushes spheres which nothing holds. Sums over the free
/// particles, of the outward forces of bonds and contacts over the inward ones of the pressure:
/// equal where all is at rest. 0 without pressure. Called on every rank.
double held_pressure(const World& world);

/// (B89): fills the columns stress_normal and stress_shear of the particles, with F (x) arm over a
/// particle's bonds and contacts and, for its volume, its share of the specimen's by r^3 (r^2 of
/// discs); its strain (S5.20); and force, stresses and failure_state of the bonds. Of several
/// ranks, for the rows that this one owns.
void fill_stress_columns(World& world);

}  // namespace breccia
