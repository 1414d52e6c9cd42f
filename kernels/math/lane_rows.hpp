// Rows of three numbers in memory, columns of them in wide registers: how a batch fetches what its
// ends do, and hands back one row of force for each bond. A row is 32 bytes long and so aligned
// (Vec3): one load, never across two cache lines. Included by files that are compiled per
// instruction set only.
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <experimental/simd>

#include "kernels/math/four.hpp"

namespace breccia::BRECCIA_ISA {
namespace {

using Lanes = std::experimental::native_simd<double>;
inline constexpr std::size_t width = Lanes::size();

[[gnu::always_inline]] inline double sum_of_lanes(const Lanes& a) { return std::experimental::reduce(a); }

using Register [[gnu::vector_size(8 * width)]] = double;  // a column over the batch

#if defined(__AVX512F__)
/// Two rows in one register: a below, b above.
[[gnu::always_inline]] inline Register joined(const Four& a, const Four& b) {
  return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
}
#endif

/// One row for each lane of a batch, row_of(lane), as three columns over the lanes.
template <class RowOf>
[[gnu::always_inline]] inline Vec<Lanes> columns_of(const RowOf& row_of) {
#if defined(__AVX512F__)
  // pairs of rows (0,2), (1,3), (4,6), (5,7): neighbours are interleaved first, then quarters put
  // in order
  const Register a = joined(row_of(0), row_of(2)), b = joined(row_of(1), row_of(3)),
                 c = joined(row_of(4), row_of(6)), d = joined(row_of(5), row_of(7));
  const Register xz_low = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
  const Register xz_high = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14);
  const Register y_low = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
  const Register y_high = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
  return {std::bit_cast<Lanes>(__builtin_shufflevector(xz_low, xz_high, 0, 1, 4, 5, 8, 9, 12, 13)),
          std::bit_cast<Lanes>(__builtin_shufflevector(y_low, y_high, 0, 1, 4, 5, 8, 9, 12, 13)),
          std::bit_cast<Lanes>(__builtin_shufflevector(xz_low, xz_high, 2, 3, 6, 7, 10, 11, 14, 15))};
#elif defined(__AVX__)
  const Register a = row_of(0), b = row_of(1), c = row_of(2), d = row_of(3);
  const Register xz_low = __builtin_shufflevector(a, b, 0, 4, 2, 6),
                 xz_high = __builtin_shufflevector(c, d, 0, 4, 2, 6);
  const Register y_low = __builtin_shufflevector(a, b, 1, 5, 3, 7),
                 y_high = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  return {std::bit_cast<Lanes>(__builtin_shufflevector(xz_low, xz_high, 0, 1, 4, 5)),
          std::bit_cast<Lanes>(__builtin_shufflevector(y_low, y_high, 0, 1, 4, 5)),
          std::bit_cast<Lanes>(__builtin_shufflevector(xz_low, xz_high, 2, 3, 6, 7))};
#else
  Four rows[width];
  for (std::size_t k = 0; k < width; ++k) rows[k] = row_of(k);
  const auto column = [&](std::size_t component) {
    return Lanes([&](auto k) __attribute__((always_inline)) { return rows[k][component]; });
  };
  return {column(0), column(1), column(2)};
#endif
}

/// The columns of a batch as rows, `stride` of them apart, the way back; what fills a row up is
/// zero.
[[gnu::always_inline]] inline void store_rows(const Vec<Lanes>& v, Vec3* rows, std::size_t stride) {
#if defined(__AVX512F__)
  const auto x = std::bit_cast<Register>(v.x), y = std::bit_cast<Register>(v.y),
             z = std::bit_cast<Register>(v.z);
  const Register zero{};
  const auto put = [&](std::size_t k, const Register& xy,
                       const Register& z0) {  // rows k, k + 2, k + 4, k + 6
    const Register pair = __builtin_shufflevector(xy, z0, 0, 1, 8, 9, 4, 5, 12, 13);
    const Register next = __builtin_shufflevector(xy, z0, 2, 3, 10, 11, 6, 7, 14, 15);
    four(rows[k * stride]) = __builtin_shufflevector(pair, pair, 0, 1, 2, 3);
    four(rows[(k + 2) * stride]) = __builtin_shufflevector(next, next, 0, 1, 2, 3);
    four(rows[(k + 4) * stride]) = __builtin_shufflevector(pair, pair, 4, 5, 6, 7);
    four(rows[(k + 6) * stride]) = __builtin_shufflevector(next, next, 4, 5, 6, 7);
  };
  put(0, __builtin_shufflevector(x, y, 0, 8, 2, 10, 4, 12, 6, 14),
      __builtin_shufflevector(z, zero, 0, 8, 2, 10, 4, 12, 6, 14));
  put(1, __builtin_shufflevector(x, y, 1, 9, 3, 11, 5, 13, 7, 15),
      __builtin_shufflevector(z, zero, 1, 9, 3, 11, 5, 13, 7, 15));
#elif defined(__AVX__)
  const auto x = std::bit_cast<Register>(v.x), y = std::bit_cast<Register>(v.y),
             z = std::bit_cast<Register>(v.z);
  const Register zero{};
  const auto put = [&](std::size_t k, const Register& xy, const Register& z0) {  // rows k, k + 2
    four(rows[k * stride]) = __builtin_shufflevector(xy, z0, 0, 1, 4, 5);
    four(rows[(k + 2) * stride]) = __builtin_shufflevector(xy, z0, 2, 3, 6, 7);
  };
  put(0, __builtin_shufflevector(x, y, 0, 4, 2, 6), __builtin_shufflevector(z, zero, 0, 4, 2, 6));
  put(1, __builtin_shufflevector(x, y, 1, 5, 3, 7), __builtin_shufflevector(z, zero, 1, 5, 3, 7));
#else
  for (std::size_t k = 0; k < width; ++k) rows[k * stride] = {v.x[k], v.y[k], v.z[k]};
#endif
}

}  // namespace
}  // namespace breccia::BRECCIA_ISA
