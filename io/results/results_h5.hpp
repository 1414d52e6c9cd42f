// results.h5: every particle and bond of every frame of every run, in double precision, for
// scripts.
//
//   /                     version, case (the resolved TOML)
//   /run-K                the numbers given, e.g. confinement_Pa
//     particles, bonds    columns that stay: identity, reference
//     frame-NNN           time_s, step, axial_strain
//       particles, bonds  columns that change: history, state, derived; bonds/state as a byte
//
// Several ranks write it together, each a part of every column. One dataset per column (Vec3: N x
// 3) with the attributes unit, role and meaning; columns of features that the scene leaves out are
// absent. Particles in order of gid, bonds of (gid_lo, gid_hi): row i is the same body in every
// frame.
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/ranks/partition.hpp"
#include "core/tables/bond_table.hpp"
#include "core/tables/particle_table.hpp"

namespace breccia {

struct FrameStamp {
  double time_s = 0;
  std::uint64_t step = 0;
  double axial_strain = 0;
};

/// Makes the file, with no run in it; one that is there is replaced.
/// @param case_text  the resolved case
/// @throws WriteError; an existing file is then as it was
void create_results(const std::filesystem::path& file, std::string_view case_text);

/// Adds /run-K with what stays the same during the run; a run of that number that is there is
/// replaced. Called on every rank.
/// @param attributes  of the run: names with their units, e.g. {"confinement_Pa", 4.5e6}
/// @param partition       which rows this rank owns
/// @throws WriteError; the runs before it stay readable, on a full disk too
void begin_run(const std::filesystem::path& file, int run,
               std::span<const std::pair<std::string, double>> attributes, const Partition& partition,
               const ParticleTable& particles, const BondTable& bonds);

/// True when the file has /run-K. @throws WriteError when it cannot be read
bool has_run(const std::filesystem::path& file, int run);

/// Adds /run-K/frame-NNN; a frame of that number that is there, from before a resume, is replaced.
/// The file is opened and closed in here: between frames it is whole, whatever becomes of the
/// process. Called on every rank.
/// @throws WriteError; the frames before it stay readable, on a full disk too
void append_frame(const std::filesystem::path& file, int run, int frame, const FrameStamp& stamp,
                  const Partition& partition, const ParticleTable& particles, const BondTable& bonds);

}  // namespace breccia
