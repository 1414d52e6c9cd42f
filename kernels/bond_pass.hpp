// One pass over a range of bonds: motion of the ends, law, forces. Compiled once per instruction set and
// feature set.
#pragma once
#include <cstddef>
#include <span>

#include "kernels/bond_laws.hpp"
#include "kernels/instruction_set.hpp"
#include "kernels/scatter.hpp"

namespace breccia {

/// Bonds are padded to a multiple of this, whatever the register's width.
inline constexpr std::size_t bond_batch = 8;

/// What the pass reads. Particle spans by particle row, bond spans by bond row.
struct BondPassIn {
  double dt = 0;              ///< s
  const void* law = nullptr;  ///< constants, of the type that the kernel was chosen for (see constants_of)
  std::span<const Vec3> position, velocity, spin;
  std::span<const Index> row_lo, row_hi;
  std::span<const double> arm_offset, rest_length, area, strength_area, stiffness, damping;
};

/// What the pass changes; columns of absent features are empty.
struct BondPassHistory {
  std::span<double> shear_x, shear_y, shear_z, plastic_stretch, damage_normal, damage_shear;
};

/// A bond that broke in this step, as it was before.
struct FreshBreak {
  Index bond;
  Vec3 shear;  ///< N, the history, as of the other three
  double plastic_stretch, damage_normal, damage_shear;
};

/// Where a range notes its fresh breaks; those beyond the room are counted only.
struct BreakNotes {
  std::span<FreshBreak> room;
  std::size_t count = 0;
};

/// Bonds [first, last), both multiples of `bond_batch`. Breaks are noted unless the pointer is null.
using BondPass = void (*)(const BondPassIn&, const BondPassHistory&, std::size_t first, std::size_t last,
                          const Scatter&, BreakNotes*);

/// The feature set that will run for a scene: the one asked for, or its nearest superset that is built for
/// the law.
/// @throws std::invalid_argument when none is
Features built_features(const BondLaw& law, const Features& asked);

/// The kernel for features that are built (see built_features).
BondPass bond_pass_for(const BondLaw& law, const Features& built, InstructionSet set);

/// The law's constants as the kernel takes them; valid as long as the law.
inline const void* constants_of(const BondLaw& law) {
  return std::visit([](const auto& l) -> const void* { return &l; }, law);
}

}  // namespace breccia
