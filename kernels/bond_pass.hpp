// One pass over a range of bonds: motion of the ends, law, forces. Compiled once per instruction set and
// feature set.
#pragma once
#include <cstddef>
#include <span>
#include <string_view>

#include "kernels/dempack.hpp"
#include "kernels/features.hpp"
#include "kernels/scatter.hpp"

namespace breccia {

/// Bonds are padded to a multiple of this, whatever the register's width.
inline constexpr std::size_t bond_batch = 8;

/// What the pass reads. Particle spans by particle row, bond spans by bond row.
struct BondPassIn {
  double dt = 0;  ///< s
  DempackLaw law;
  std::span<const Vec3> position, velocity, spin;
  std::span<const double> radius;
  std::span<const Index> row_lo, row_hi;
  std::span<const double> rest_length, area, stiffness, damping;
};

/// What the pass changes; columns of absent features are empty.
struct BondPassHistory {
  std::span<double> shear_x, shear_y, shear_z, plastic_stretch, damage_normal, damage_shear;
};

/// Bonds [first, last), both multiples of `bond_batch`.
using BondPass = void (*)(const BondPassIn&, const BondPassHistory&, std::size_t first, std::size_t last,
                          const Scatter&);

enum class InstructionSet { x86_64, x86_64_v3, x86_64_v4 };

std::string_view name_of(InstructionSet);

/// The widest set that this processor runs.
InstructionSet best_instruction_set();

/// The feature set that will run for a scene: the one asked for, or its nearest superset that is built.
Features built_features(const Features& asked);

/// The kernel for features that are built (see built_features).
BondPass bond_pass_for(const Features& built, InstructionSet set);

}  // namespace breccia
