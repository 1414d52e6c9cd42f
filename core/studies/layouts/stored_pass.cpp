// Compiled once per instruction set, as kernels/loops/bond_pass.cpp.
#include "core/studies/layouts/stored_pass.hpp"

#include "kernels/loops/bond_loop.hpp"

namespace breccia::BRECCIA_ISA {
namespace {

/// `block` bonds side by side, column by column; a block of 1 is a record, whose values are picked
/// one by one.
template <std::size_t block>
struct BlockBonds {
  const BondPassIn& in;
  double* const values;

  Index lo(std::size_t k) const { return in.row_lo[k]; }
  Index hi(std::size_t k) const { return in.row_hi[k]; }
  std::size_t size() const { return in.row_lo.size(); }
  const BreakEvent& in_si(const BreakEvent& event) const { return event; }

  template <Column column>
  Lanes load(std::size_t b) const {
    if constexpr (column == Column::arm_offset) {
      return Lanes(in.constants.arm_offset.data() + b, std::experimental::element_aligned);
    } else {
      const double* const first = values + address_of(block, place_of(column), b);
      if constexpr (block == 1)
        return Lanes([&](auto k) __attribute__((always_inline)) { return first[k * stored_count]; });
      else
        return Lanes(first, std::experimental::element_aligned);
    }
  }
  template <Column column>
  void store(std::size_t b, const Lanes& lanes) const {
    double* const first = values + address_of(block, place_of(column), b);
    if constexpr (block == 1)
      for (std::size_t k = 0; k < width; ++k) first[k * stored_count] = lanes[k];
    else
      lanes.copy_to(first, std::experimental::element_aligned);
  }
};

template <std::size_t block>
[[gnu::flatten]] void stored_pass(const BondPassIn& in, double* stored, std::size_t first, std::size_t last,
                                  const Scatter& to) {
  static_assert(block == 1 || block % width == 0);
  const BlockBonds<block> bonds{in, stored};
  bond_loop<Features{}, false>(*std::get_if<DempackLaw>(in.laws.data()), in.dt, ParticleRows(in), bonds,
                               first, last, to, nullptr);
}

}  // namespace

extern const StoredPass record_pass, block_8_pass, block_16_pass;
const StoredPass record_pass = stored_pass<1>, block_8_pass = stored_pass<8>, block_16_pass = stored_pass<16>;

}  // namespace breccia::BRECCIA_ISA
