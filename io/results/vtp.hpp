// Pictures for ParaView: particles as points, bonds as lines, one .pvd a run with the times.
#pragma once
#include <filesystem>

#include "core/tables/bond_table.hpp"
#include "core/tables/particle_table.hpp"

namespace breccia {

/// The particles as vertices, in order of global id. Point data: `displacement` since the bonds
/// were made, `held` (1 = belongs to a platen), and every column that is not scratch. SI, single
/// precision but for the ids.
/// @throws WriteError
void write_particles_vtp(const std::filesystem::path& file, const ParticleTable& particles);

/// The bonds as lines between the particles' centres, in order of (gid_lo, gid_hi). Cell data:
/// `state` (see BondState) and every column that is not scratch.
/// @throws WriteError
void write_bonds_vtp(const std::filesystem::path& file, const ParticleTable& particles,
                     const BondTable& bonds);

/// Writes FRAMES/run-K/{particles,bonds}-NNN.vtp and then FRAMES/run-K.pvd (part 0: particles, 1:
/// bonds), making the folders. The .pvd keeps the frames below this one that it lists already, so
/// that a resumed run continues it.
/// @param time_s  of the frame
/// @throws WriteError
void write_frame_vtp(const std::filesystem::path& frames, int run, int frame, double time_s,
                     const ParticleTable& particles, const BondTable& bonds);

}  // namespace breccia
