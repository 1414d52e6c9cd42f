// What the loop reads and writes of the bonds, laid out in other ways than the columns of the
// table. Rows of the ends and the shares of the arms stay columns in all of them: the sums read
// those too.
#pragma once
#include <tbb/cache_aligned_allocator.h>

#include <cstddef>
#include <vector>

#include "core/tables/bond_table.hpp"
#include "kernels/loops/bond_column.hpp"

namespace breccia {

/// records: array of structures. blocks: as many bonds side by side, column by column (AoSoA)
enum class BondStorage { columns, records, blocks_8, blocks_16 };

namespace {  // internal linkage: also compiled for wide registers

/// Columns that a record or block holds, in this order. The strengths stand on the area itself.
inline constexpr BondColumn stored_columns[] = {
    BondColumn::area,          BondColumn::stiffness,   BondColumn::damping, BondColumn::rest_length,
    BondColumn::shear_x,       BondColumn::shear_y,     BondColumn::shear_z, BondColumn::plastic_stretch,
    BondColumn::damage_normal, BondColumn::damage_shear};
inline constexpr std::size_t stored_count = std::size(stored_columns);

constexpr std::size_t place_of(BondColumn column) {
  if (column == BondColumn::strength_area) column = BondColumn::area;
  std::size_t k = 0;
  while (stored_columns[k] != column) ++k;
  return k;
}

/// Bonds whose values of one column lie side by side.
constexpr std::size_t block_of(BondStorage storage) {
  return storage == BondStorage::blocks_16 ? 16 : storage == BondStorage::blocks_8 ? 8 : 1;
}

/// Where the value of a bond lies, given the place of its column.
constexpr std::size_t address_of(std::size_t block, std::size_t place, std::size_t bond) {
  return (bond / block * stored_count + place) * block + bond % block;
}

}  // namespace

using StoredBonds = std::vector<double, tbb::cache_aligned_allocator<double>>;

/// @param bonds  with all features, strengths standing on the area of the stiffness
StoredBonds store_bonds(const BondTable& bonds, BondStorage storage);

/// Copies what the bonds remember back into the table.
void restore_history(const StoredBonds& stored, BondStorage storage, BondTable& bonds);

}  // namespace breccia
