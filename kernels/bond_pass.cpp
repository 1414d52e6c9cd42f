// Compiled once per instruction set (BRECCIA_ISA names it), each in a namespace of its own, so that no
// function built for wide registers can be linked into code that runs without them.
#include "kernels/bond_pass.hpp"

#include "kernels/bond_loop.hpp"
#include "kernels/kernel_list.hpp"

namespace breccia::BRECCIA_ISA {
namespace {

/// Bonds as a structure of arrays of `Stored`; the rest length, from which small stretches are subtracted, is
/// a double always.
template <class Stored>
struct ColumnBonds {
  const BondPassIn& in;
  const BondConstantColumns<Stored>& constants;
  const BondHistoryColumns<Stored>& history;

  Index lo(std::size_t k) const { return in.row_lo[k]; }
  Index hi(std::size_t k) const { return in.row_hi[k]; }
  std::size_t size() const { return in.row_lo.size(); }

  template <Column column>
  Lanes load(std::size_t b) const {
    return Lanes(values<column>().data() + b, std::experimental::element_aligned);
  }
  template <Column column>
  void store(std::size_t b, const Lanes& lanes) const {
    lanes.copy_to(values<column>().data() + b, std::experimental::element_aligned);
  }

private:
  template <Column column>
  const auto& values() const {
    if constexpr (column == Column::arm_offset) return constants.arm_offset;
    if constexpr (column == Column::area) return constants.area;
    if constexpr (column == Column::strength_area) return constants.strength_area;
    if constexpr (column == Column::stiffness) return constants.stiffness;
    if constexpr (column == Column::damping) return constants.damping;
    if constexpr (column == Column::rest_length) return in.rest_length;
    if constexpr (column == Column::shear_x) return history.shear_x;
    if constexpr (column == Column::shear_y) return history.shear_y;
    if constexpr (column == Column::shear_z) return history.shear_z;
    if constexpr (column == Column::plastic_stretch) return history.plastic_stretch;
    if constexpr (column == Column::damage_normal) return history.damage_normal;
    if constexpr (column == Column::damage_shear) return history.damage_shear;
  }
};

ParticleRows rows_of(const BondPassIn& in) { return {in.position, in.velocity, in.spin}; }

template <class Law, Features features>
[[gnu::flatten]] void bond_pass(const BondPassIn& in, const BondPassHistory& history, std::size_t first,
                                std::size_t last, const Scatter& to, BreakNotes* notes) {
  const ColumnBonds<double> bonds{in, in.constants, history.full};
  bond_loop<features>(*static_cast<const Law*>(in.law), in.dt, rows_of(in), bonds, first, last, to, notes);
}

template <class Law, Features features>
[[gnu::flatten]] void mixed_pass(const BondPassIn& in, const BondPassHistory& history, std::size_t first,
                                 std::size_t last, const Scatter& to, BreakNotes* notes) {
  const ColumnBonds<float> bonds{in, in.narrow_constants, history.narrow};
  bond_loop<features>(*static_cast<const Law*>(in.law), in.dt, rows_of(in), bonds, first, last, to, notes);
}

template <std::size_t... k>
constexpr std::array<BondPass, sizeof...(k)> all_passes(std::index_sequence<k...>) {
  return {bond_pass<LawOfKernel<k>, kernel_list[k].features>...};
}

}  // namespace

extern const std::array<BondPass, kernel_list.size()> passes;
const std::array<BondPass, kernel_list.size()> passes =
    all_passes(std::make_index_sequence<kernel_list.size()>{});

extern const BondPass mixed;
const BondPass mixed = mixed_pass<LawOfKernel<mixed_kernel>, kernel_list[mixed_kernel].features>;

}  // namespace breccia::BRECCIA_ISA
