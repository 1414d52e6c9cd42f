// What the bonds that have no damage store, in wide registers: the same for every law. A row of a
// curve asks for it.
#pragma once
#include <span>

#include "kernels/loops/scatter.hpp"
#include "kernels/math/instruction_set.hpp"

namespace breccia {

/// Columns of absent features are empty.
struct BondEnergyIn {
  Strided<const Vec3> position, velocity;
  std::span<const Index> row_lo, row_hi;
  std::span<const double> rest_length, stiffness, shear_x, shear_y, shear_z, plastic_stretch, damage_normal,
      damage_shear;
  double back = 0;         ///< s, places are taken so long before
  double shear_ratio = 0;  ///< k_s/k_n
};

/// J, of those bonds [first, last) without damage: 1/2 k_n u_e^2 + |F_s|^2/(2 k_s). (B50)
using UndamagedEnergy = double (*)(const BondEnergyIn&, std::size_t first, std::size_t last);
UndamagedEnergy undamaged_energy_for(InstructionSet set);

}  // namespace breccia
