// Spheres of the lateral surface that nothing holds.
#pragma once
#include "core/boundary/platens_and_confinement.hpp"

namespace breccia {

/// What surrounds a pressed specimen.
struct Surroundings {
  double impedance = 0;  ///< Pa s/m, sqrt(E density) of the specimen
  bool rough = true;     ///< platens hold their layers sideways
  double dt = 0;         ///< s
  std::uint64_t step = 0;
};

/// (B112): a sphere on which nothing acts but the pressure drifts in the fluid: its speed is held
/// to 0.1 p/sqrt(E density), at which it does no harm where it arrives. Pushed on, it would reach
/// kilometres a second under hundreds of MPa; what is pressed out from between others flies off at
/// hundreds of metres a second. Called when the forces of a step are complete; those of the
/// pressure take the difference.
void let_loose_drift(Confinement& confinement, ParticleTable& particles, const Partition& partition,
                     const Surroundings& around);

/// Whether it looks at the forces of all particles in this step, and not at those of the surface
/// alone.
bool looks_at_all(const Confinement& confinement, std::uint64_t step);

}  // namespace breccia
