// The record of cracks: one row per bond that broke, in the order of time.
#pragma once
#include <vector>

#include "core/tables/bond_table.hpp"
#include "core/tables/particle_table.hpp"
#include "kernels/loops/bond_pass.hpp"

namespace breccia {

struct Crack {
  double time = 0;          ///< s
  double axial_strain = 0;  ///< of the row of the curve in which it broke
  Gid gid_lo = 0, gid_hi = 0;
  Vec3 position;  ///< m, middle of the bond
  Vec3 normal;    ///< from lo to hi
  BondState mode = BondState::intact;
  double normal_force = 0;  ///< N, of the step before it broke, tension positive, without damping
  double shear_force = 0;   ///< N, magnitude, of the step before
  double area = 0;          ///< m^2, that its strength stood on
  double energy = 0;        ///< J, stored before less stored after
};

struct CrackRecord {
  bool enabled = true;
  std::vector<Crack> cracks;
  std::size_t collected = 0;  ///< of them, that the rows of the curve have counted
  std::size_t missed = 0;     ///< broke in a step that broke more bonds at once than are noted

  std::vector<std::vector<BreakEvent>> room;  ///< per range of bonds
  std::vector<BreakNotes> notes;
};

/// @param ranges  of the bond pass
CrackRecord make_crack_record(bool enabled, int ranges, std::size_t bonds);

/// Where a range notes its breaks in this step; null when nobody asked.
BreakNotes* notes_of(CrackRecord& record, int range);

/// After the pass: turns the notes into rows.
void record_cracks(CrackRecord& record, std::span<const BondLaw> laws, bool coupled, double time, double dt,
                   const ParticleTable& particles, const BondTable& bonds);

}  // namespace breccia
