#include "core/tables/mixed_precision.hpp"

#include <algorithm>

namespace breccia {
namespace {

Column<float> narrowed(const Column<double>& column) {
  Column<float> narrow(column.size());
  std::transform(column.begin(), column.end(), narrow.begin(),
                 [](double v) { return static_cast<float>(v); });
  return narrow;
}

}  // namespace

SingleBonds single_bonds(const BondTable& b) {
  return {narrowed(b.arm_offset),    narrowed(b.area),        narrowed(b.strength_area),
          narrowed(b.stiffness),     narrowed(b.damping),     narrowed(b.shear_x),
          narrowed(b.shear_y),       narrowed(b.shear_z),     narrowed(b.plastic_stretch),
          narrowed(b.damage_normal), narrowed(b.damage_shear)};
}

void dashpots_to_single(const BondTable& b, SingleBonds& narrow) { narrow.damping = narrowed(b.damping); }

void history_to_double(const SingleBonds& narrow, std::size_t first, std::size_t last, BondTable& b) {
  const auto widen = [&](const Column<float>& from, Column<double>& to) {
    for (std::size_t k = first; k < std::min(last, from.size()); ++k) to[k] = from[k];
  };
  widen(narrow.shear_x, b.shear_x);
  widen(narrow.shear_y, b.shear_y);
  widen(narrow.shear_z, b.shear_z);
  widen(narrow.plastic_stretch, b.plastic_stretch);
  widen(narrow.damage_normal, b.damage_normal);
  widen(narrow.damage_shear, b.damage_shear);
}

}  // namespace breccia
