// Strain from the places of a particle's neighbours, and how much of a specimen it has gathered in.
#pragma once
#include "core/world/world.hpp"

namespace breccia {

/// Symmetric tensor, elongation positive.
struct Strain {
  Vec3 normal;  ///< xx, yy, zz
  Vec3 shear;   ///< yz, zx, xy, half the change of the angle

  /// sqrt(2/3 e:e) of the deviatoric part: the axial strain of a body that keeps its volume.
  double equivalent() const;
};

/// (S5.20): of each particle, the symmetric part of the gradient that fits the displacements of the
/// particles it was bonded to at the start, intact or not, by least squares; nothing where those do
/// not span space.
std::vector<Strain> strains(const World& world);

/// (B114): share of the volume that holds nine tenths of the equivalent strain, free particles by
/// their r^3; 0.9 where strain is even.
double localisation(const World& world);

}  // namespace breccia
