// Mixed precision: parameters and history of the bonds as floats, which is what the loop then reads and
// writes. The table of bonds stays what everything else reads; its history is brought up to date where it is
// looked at (settle in core/world.hpp).
#pragma once
#include <vector>

#include "core/bond_table.hpp"
#include "kernels/bond_pass.hpp"

namespace breccia {

/// Empty where the scene runs in full precision; columns of absent features are empty.
struct NarrowBonds {
  std::vector<float> arm_offset, area, strength_area, stiffness, damping;
  std::vector<float> shear_x, shear_y, shear_z, plastic_stretch, damage_normal, damage_shear;

  bool empty() const { return area.empty(); }
  BondConstantColumns<float> constants() const {
    return {arm_offset, area, strength_area.empty() ? area : strength_area, stiffness, damping};
  }
  BondHistoryColumns<float> history() {
    return {shear_x, shear_y, shear_z, plastic_stretch, damage_normal, damage_shear};
  }
};

NarrowBonds narrow_bonds(const BondTable& bonds);

/// Takes the dashpots anew.
void narrow_dashpots(const BondTable& bonds, NarrowBonds& narrow);

/// Copies the history of bonds [first, last) into the table.
void widen_history(const NarrowBonds& narrow, std::size_t first, std::size_t last, BondTable& bonds);

}  // namespace breccia
