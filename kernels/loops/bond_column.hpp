// What the loop over bonds reads and writes of each.
#pragma once

namespace breccia {

enum class BondColumn {
  arm_offset,
  area,
  strength_area,
  stiffness,
  damping,
  rest_length,
  shear_x,
  shear_y,
  shear_z,
  plastic_stretch,
  damage_normal,
  damage_shear,
  spring_force,
  viscous_force,
  shear_factor
};

}  // namespace breccia
