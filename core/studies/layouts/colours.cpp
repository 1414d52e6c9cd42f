#include "core/studies/layouts/colours.hpp"

#include <bit>
#include <cstdint>

#include "core/base/error.hpp"
#include "kernels/loops/bond_pass.hpp"

namespace breccia {
namespace {

using Taken = std::uint64_t;  ///< colours of a particle's bonds, a bit each

}  // namespace

ColouredBonds colour_bonds(const BondTable& bonds, std::size_t particles) {
  std::vector<Taken> taken(particles);
  std::vector<std::vector<Row>> colours;
  for (std::size_t b = 0; b < bonds.size; ++b) {
    Taken &lo = taken[bonds.row_lo[b]], &hi = taken[bonds.row_hi[b]];
    const auto colour = static_cast<std::size_t>(std::countr_one(lo | hi));
    if (colour == 64) fail<BadInput>("a particle has too many bonds for 64 colours");
    lo |= Taken{1} << colour, hi |= Taken{1} << colour;
    if (colour == colours.size()) colours.emplace_back();
    colours[colour].push_back(static_cast<Row>(b));
  }

  ColouredBonds coloured;
  std::vector<bool> is_padding;
  for (const std::vector<Row>& colour : colours) {
    coloured.first.push_back(coloured.source.size());
    coloured.source.insert(coloured.source.end(), colour.begin(), colour.end());
    is_padding.resize(coloured.source.size(), false);
    // padding repeats a bond of its own batch: the range that adds its nothing owns those ends
    while (coloured.source.size() % bond_batch != 0) coloured.source.push_back(colour.back());
    is_padding.resize(coloured.source.size(), true);
  }
  coloured.first.push_back(coloured.source.size());

  BondTable& out = coloured.bonds;
  out = bonds;
  out.size = out.padded = coloured.source.size();
  out.for_each_column([&](const ColumnInfo&, auto& column) {
    if (column.empty()) return;
    const auto before = column;
    column.resize(out.padded);
    for (std::size_t b = 0; b < out.padded; ++b) column[b] = before[coloured.source[b]];
  });
  for (std::size_t b = 0; b < out.padded; ++b)
    if (is_padding[b]) {
      out.stiffness[b] = out.area[b] = 0.0;
      for (auto* column : {&out.damping, &out.shear_x, &out.shear_y, &out.shear_z, &out.plastic_stretch,
                           &out.damage_normal, &out.damage_shear})
        if (!column->empty()) (*column)[b] = 0.0;
    }
  return coloured;
}

}  // namespace breccia
