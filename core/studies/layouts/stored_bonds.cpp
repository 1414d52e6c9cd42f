#include "core/studies/layouts/stored_bonds.hpp"

#include <array>

namespace breccia {
namespace {

/// In the order of `stored_columns`.
template <class Table>
auto columns_of(Table& b) {
  return std::array{&b.area,    &b.stiffness, &b.damping,         &b.rest_length,   &b.shear_x,
                    &b.shear_y, &b.shear_z,   &b.plastic_stretch, &b.damage_normal, &b.damage_shear};
}

}  // namespace

StoredBonds store_bonds(const BondTable& bonds, BondStorage storage) {
  const std::size_t block = block_of(storage);
  StoredBonds stored((bonds.padded + block - 1) / block * block * stored_count);
  const auto columns = columns_of(bonds);
  static_assert(columns.size() == stored_count);
  for (std::size_t k = 0; k < stored_count; ++k)
    for (std::size_t b = 0; b < bonds.padded; ++b) stored[address_of(block, k, b)] = (*columns[k])[b];
  return stored;
}

void restore_history(const StoredBonds& stored, BondStorage storage, BondTable& bonds) {
  const auto columns = columns_of(bonds);
  for (std::size_t k = place_of(BondColumn::shear_x); k < stored_count; ++k)
    for (std::size_t b = 0; b < bonds.padded; ++b)
      (*columns[k])[b] = stored[address_of(block_of(storage), k, b)];
}

}  // namespace breccia
