// Compiled once per instruction set, as kernels/loops/bond_pass.cpp.
#include "kernels/loops/undamaged_energy.hpp"

#include "kernels/math/lane_rows.hpp"
#include "kernels/math/lanes.hpp"

namespace breccia::BRECCIA_ISA {
namespace {

Lanes lanes_of(std::span<const double> column, std::size_t k) {
  return column.empty() ? Lanes(0.0) : Lanes(column.data() + k, std::experimental::element_aligned);
}

/// From the lower end to the other.
Vec<Lanes> branches(const BondEnergyIn& in, std::size_t k) {
  const auto between = [&](const Strided<const Vec3>& rows) {
    return columns_of([&](std::size_t lane) -> Four {
      return four(rows[in.row_hi[k + lane]]) - four(rows[in.row_lo[k + lane]]);
    });
  };
  const Vec<Lanes> now = between(in.position);
  return in.back == 0.0 ? now : now - Lanes(in.back) * between(in.velocity);
}

Lanes energies(const BondEnergyIn& in, std::size_t k) {
  const Vec<Lanes> branch = branches(in, k);
  const Vec<Lanes> shear{lanes_of(in.shear_x, k), lanes_of(in.shear_y, k), lanes_of(in.shear_z, k)};
  const Lanes stiffness = lanes_of(in.stiffness, k);
  const Lanes stretch =
      square_root(dot(branch, branch)) - lanes_of(in.rest_length, k) - lanes_of(in.plastic_stretch, k);
  Lanes twice = stiffness * stretch * stretch;
  if (in.shear_ratio > 0.0) twice += dot(shear, shear) / (Lanes(in.shear_ratio) * stiffness);
  const auto counts =
      stiffness > 0.0 && lanes_of(in.damage_normal, k) == 0.0 && lanes_of(in.damage_shear, k) == 0.0;
  return select(counts, Lanes(0.5) * twice, Lanes(0.0));
}

}  // namespace

double undamaged_energy(const BondEnergyIn& in, std::size_t first, std::size_t last) {
  Lanes sum(0.0);
  std::size_t k = first;
  for (; k + width <= last; k += width) sum += energies(in, k);
  double total = std::experimental::reduce(sum);
  if (k < last && last >= width) {  // a last batch that ends where it must, of which only the end counts
    const Lanes end = energies(in, last - width);
    for (std::size_t lane = width - (last - k); lane < width; ++lane) total += end[lane];
  } else if (k < last) {
    const Lanes start = energies(in, 0);  // tables are padded to whole batches
    for (; k < last; ++k) total += start[k];
  }
  return total;
}

}  // namespace breccia::BRECCIA_ISA
