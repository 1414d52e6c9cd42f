// Spheres of the lateral surface that nothing holds lose their confining pressure.
#pragma once
#include "core/boundary/platens_and_confinement.hpp"

namespace breccia {

/// (B112): a sphere on which nothing has acted but the pressure, for as long as the pressure takes
/// to move it by its radius, is beside the specimen or outside of it, not on its surface; pushed on
/// it would reach kilometres a second. It is free of pressure from then on. Looked at every 16
/// steps, when forces are complete.
void release_unheld(Confinement& confinement, const ParticleTable& particles, const Partition& partition,
                    std::uint64_t step, double dt);

/// Of a sphere that is pressed no more.
inline constexpr double released = -1.0;

/// Ids of those of the lateral surface that are pressed no more, or touch nothing now; the same on
/// every rank.
std::vector<Gid> unheld(const Confinement& confinement, const ParticleTable& particles,
                        const Partition& partition);

/// Brings to the root what each rank knows of its part of the lateral surface.
std::vector<double> gather_unheld(const Confinement& confinement, const Partition& partition);

}  // namespace breccia
