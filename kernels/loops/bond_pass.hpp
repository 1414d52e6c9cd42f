// One pass over a range of bonds: motion of the ends, law, forces. Compiled once per instruction
// set and feature set.
#pragma once
#include <cstddef>
#include <span>

#include "kernels/laws/bond_laws.hpp"
#include "kernels/loops/bond_ledger.hpp"
#include "kernels/loops/scatter.hpp"
#include "kernels/math/instruction_set.hpp"

namespace breccia {

/// Bonds are padded to a multiple of this, whatever the register's width.
inline constexpr std::size_t bond_batch = 8;

/// What does not change of the bonds, beside their rest length.
struct BondConstantColumns {
  std::span<const double> arm_offset, area, strength_area, stiffness, damping;
};

/// What the pass changes.
struct BondHistoryColumns {
  std::span<double> shear_x, shear_y, shear_z, plastic_stretch, damage_normal, damage_shear;
};

/// What the pass reads. Rows of particles (velocities and spins as far apart as positions), spans
/// by bond row; columns of absent features are empty.
struct BondPassIn {
  double dt = 0;  ///< s
  std::span<const BondLaw>
      laws;  ///< of the kind that the kernel was chosen for; one, but of several materials
  Strided<const Vec3> position, velocity, spin;
  std::span<const Index> row_lo, row_hi;
  std::span<const double> rest_length;
  BondConstantColumns constants;
  std::span<const LawIndex> law = {};  ///< of several materials: which of the laws
};

/// What the pass keeps of energies, where the scene has a ledger.
struct BondLedgerColumns {
  std::span<double> spring_force, viscous_force, shear_factor;
  std::span<BondLosses<double>> losses;  ///< J, since the start, a sum for each 64 bonds
};

struct BondPassHistory {
  BondHistoryColumns columns;
  BondLedgerColumns ledger{};
};

/// A bond that broke in this step, as it was before.
struct BreakEvent {
  Index bond;
  Vec3 shear;  ///< N, the history, as of the other three
  double plastic_stretch, damage_normal, damage_shear;
};

/// Where a range notes its fresh breaks; those beyond the room are counted only.
struct BreakNotes {
  std::span<BreakEvent> room;
  std::size_t count = 0;
};

/// Bonds [first, last), both multiples of `bond_batch`, `first` of ForceBuffer::capacity where
/// there is a ledger. Breaks are noted unless the pointer is null.
using BondPass = void (*)(const BondPassIn&, const BondPassHistory&, std::size_t first, std::size_t last,
                          const Scatter&, BreakNotes*);

/// The feature set that will run for a scene: the one asked for, or its nearest superset that is
/// built for the law.
/// @throws std::invalid_argument when none is
Features built_features(const BondLaw& law, const Features& asked, const LoopKind& kind = {});

/// The kernel for features that are built (see built_features).
/// @throws std::invalid_argument when there is none, or none of this kind
BondPass bond_pass_for(const BondLaw& law, const Features& built, InstructionSet set,
                       const LoopKind& kind = {});

}  // namespace breccia
