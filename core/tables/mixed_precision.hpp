// Mixed precision: parameters and history of the bonds as floats, which is what the loop then reads
// and writes. The table of bonds stays what everything else reads; its history is brought up to
// date where it is looked at (sync in core/world/world.hpp).
#pragma once
#include "core/tables/bond_table.hpp"
#include "kernels/loops/bond_pass.hpp"

namespace breccia {

/// Empty where the scene runs in full precision; columns of absent features are empty.
struct SingleBonds {
  Column<float> arm_offset, area, strength_area, stiffness, damping;
  Column<float> shear_x, shear_y, shear_z, plastic_stretch, damage_normal, damage_shear;

  bool empty() const { return area.empty(); }
  BondConstantColumns<float> constants() const {
    return {arm_offset, area, strength_area.empty() ? area : strength_area, stiffness, damping};
  }
  BondHistoryColumns<float> history() {
    return {shear_x, shear_y, shear_z, plastic_stretch, damage_normal, damage_shear};
  }
};

SingleBonds single_bonds(const BondTable& bonds);

/// Takes the dashpots anew.
void dashpots_to_single(const BondTable& bonds, SingleBonds& narrow);

/// Copies the history of bonds [first, last) into the table.
void history_to_double(const SingleBonds& narrow, std::size_t first, std::size_t last, BondTable& bonds);

}  // namespace breccia
