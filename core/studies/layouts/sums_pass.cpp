// Compiled once per instruction set, as kernels/single/single_pass.cpp.
#include "core/studies/layouts/stored_pass.hpp"
#include "kernels/laws/bond_laws.hpp"
#include "kernels/math/flatten.hpp"
#include "kernels/single/single_loop.hpp"

namespace breccia::BRECCIA_ISA {
namespace {

using Ints [[gnu::vector_size(32)]] = std::int32_t;
using Longs [[gnu::vector_size(64), gnu::may_alias]] = std::int64_t;
using Floats [[gnu::vector_size(32), gnu::may_alias]] = float;

struct LongRows {
  using Sum = Longs;
  static constexpr std::size_t bytes_per_unit = sizeof(Longs) / row_unit;
  [[gnu::always_inline]] static IntRegister as_kept(const FloatLanes& a) { return nearest_integers(a); }
  [[gnu::always_inline]] static IntRow opposite(const IntRow& row) { return on_hi(row); }
  [[gnu::always_inline]] static void add(Sum& sum, const IntRow& row) {
    sum += __builtin_convertvector((Ints)row, Longs);
  }
};

struct FloatRows {
  using Sum = Floats;
  static constexpr std::size_t bytes_per_unit = sizeof(Floats) / row_unit;
  [[gnu::always_inline]] static IntRegister as_kept(const FloatLanes& a) {
    return std::bit_cast<IntRegister>(a.v);
  }
  [[gnu::always_inline]] static IntRow opposite(const IntRow& row) {
    constexpr std::uint32_t sign = 0x80000000u;
    return row ^ IntRow { sign, sign, sign, 0, 0, 0, 0, 0 };
  }
  [[gnu::always_inline]] static void add(Sum& sum, const IntRow& row) { sum += (Floats)row; }
};

template <class Rows>
BRECCIA_FLATTEN void sums_pass(const SinglePassIn& in, void* sums, std::size_t first, std::size_t last,
                               std::vector<LoadApart>& apart) {
  single_loop<Features{}, Rows>(*std::get_if<DempackLaw>(in.laws.data()), in, sums, first, last, nullptr,
                                apart);
}

}  // namespace

extern const SumsPass long_pass, float_pass;
const SumsPass long_pass = sums_pass<LongRows>, float_pass = sums_pass<FloatRows>;

}  // namespace breccia::BRECCIA_ISA
