// Compiled once per instruction set (BRECCIA_ISA names it), each in a namespace of its own, so that
// no function built for wide registers can be linked into code that runs without them.
#include "kernels/loops/bond_pass.hpp"

#include "kernels/loops/bond_loop.hpp"
#include "kernels/loops/kernel_list.hpp"
#include "kernels/math/flatten.hpp"

namespace breccia::BRECCIA_ISA {
namespace {

/// Bonds as a structure of arrays.
struct ColumnBonds {
  const BondPassIn& in;
  const BondConstantColumns& constants;
  const BondHistoryColumns& history;
  const BondLedgerColumns& ledger;

  Index lo(std::size_t k) const { return in.row_lo[k]; }
  Index hi(std::size_t k) const { return in.row_hi[k]; }
  std::size_t size() const { return in.row_lo.size(); }

  const BreakEvent& in_si(const BreakEvent& event) const { return event; }

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
    if constexpr (column == Column::spring_force) return ledger.spring_force;
    if constexpr (column == Column::viscous_force) return ledger.viscous_force;
    if constexpr (column == Column::shear_factor) return ledger.shear_factor;
  }
};

template <std::size_t k>
BRECCIA_FLATTEN void bond_pass(const BondPassIn& in, const BondPassHistory& history, std::size_t first,
                               std::size_t last, const Scatter& to, BreakNotes* notes) {
  constexpr KernelKind kernel = kernel_list[k];
  using Law = LawOfKernel<k>;
  const ColumnBonds bonds{in, in.constants, history.columns, history.ledger};
  const auto under = [&](const auto& law) {
    bond_loop<kernel.features, kernel.kind.ledger>(law, in.dt, ParticleRows(in), bonds, first, last, to,
                                                   notes, history.ledger.losses);
  };
  if constexpr (kernel.features.several)
    under(LawTable<Law>{in.laws, in.law});
  else
    under(*std::get_if<Law>(in.laws.data()));
}

template <std::size_t... k>
constexpr std::array<BondPass, sizeof...(k)> all_passes(std::index_sequence<k...>) {
  return {bond_pass<k>...};
}

}  // namespace

extern const std::array<BondPass, kernel_list.size()> passes;
const std::array<BondPass, kernel_list.size()> passes =
    all_passes(std::make_index_sequence<kernel_list.size()>{});

}  // namespace breccia::BRECCIA_ISA
