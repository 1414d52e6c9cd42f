// Records of sixteen integers in memory, columns of them in wide registers: how a batch of bonds
// fetches what its ends do in the loop in single precision, and hands back a row of eight integers
// for each bond. The same steps for registers of four, eight and sixteen: rows of four are turned
// within lanes of 128 bits, then these lanes are put in order. Included by files that are compiled
// per instruction set only.
#pragma once
#include <immintrin.h>

#include "kernels/math/float_lanes.hpp"

namespace breccia::BRECCIA_ISA {
namespace {

inline constexpr std::size_t quads = float_width / 4;  // lanes of 128 bits in a register
using Quads [[gnu::vector_size(4 * float_width)]] = long long;
// unsigned, since they add up modulo 2^32
using IntRow [[gnu::vector_size(32), gnu::may_alias]] = std::uint32_t;
using Wrapping [[gnu::vector_size(4 * float_width), gnu::may_alias]] = std::uint32_t;

// --- within lanes of 128 bits
template <std::size_t... k>
[[gnu::always_inline]] inline IntRegister low_pairs(const IntRegister& a, const IntRegister& b,
                                                    std::index_sequence<k...>) {
  return __builtin_shufflevector(a, b, (k / 4 * 4 + k % 4 / 2 + k % 2 * float_width)...);
}
template <std::size_t... k>
[[gnu::always_inline]] inline IntRegister high_pairs(const IntRegister& a, const IntRegister& b,
                                                     std::index_sequence<k...>) {
  return __builtin_shufflevector(a, b, (k / 4 * 4 + 2 + k % 4 / 2 + k % 2 * float_width)...);
}
template <std::size_t... k>
[[gnu::always_inline]] inline IntRegister low_halves(const IntRegister& a, const IntRegister& b,
                                                     std::index_sequence<k...>) {
  return __builtin_shufflevector(a, b, (k / 4 * 4 + k % 2 + k % 4 / 2 * float_width)...);
}
template <std::size_t... k>
[[gnu::always_inline]] inline IntRegister high_halves(const IntRegister& a, const IntRegister& b,
                                                      std::index_sequence<k...>) {
  return __builtin_shufflevector(a, b, (k / 4 * 4 + 2 + k % 2 + k % 4 / 2 * float_width)...);
}
inline constexpr auto all_lanes = std::make_index_sequence<float_width>{};

struct Columns {
  IntRegister x, y, z;
};

/// Of four rows, in each lane of 128 bits.
[[gnu::always_inline]] inline Columns turned(const IntRegister& r0, const IntRegister& r1,
                                             const IntRegister& r2, const IntRegister& r3) {
  const IntRegister a = low_pairs(r0, r1, all_lanes), b = low_pairs(r2, r3, all_lanes);
  return {low_halves(a, b, all_lanes), high_halves(a, b, all_lanes),
          low_halves(high_pairs(r0, r1, all_lanes), high_pairs(r2, r3, all_lanes), all_lanes)};
}

// --- lanes of 128 bits among registers
struct Registers {
  IntRegister of[quads];
};

/// Lane `l` of each of `quads` registers, one after the other, for every l.
[[gnu::always_inline]] inline Registers across(const Registers& r) {
#if defined(__AVX512F__)
  const Quads r0 = (Quads)r.of[0], r1 = (Quads)r.of[1], r2 = (Quads)r.of[2], r3 = (Quads)r.of[3];
  const Quads a = __builtin_shufflevector(r0, r1, 0, 1, 2, 3, 8, 9, 10, 11),
              b = __builtin_shufflevector(r2, r3, 0, 1, 2, 3, 8, 9, 10, 11),
              c = __builtin_shufflevector(r0, r1, 4, 5, 6, 7, 12, 13, 14, 15),
              d = __builtin_shufflevector(r2, r3, 4, 5, 6, 7, 12, 13, 14, 15);
  return {{(IntRegister)__builtin_shufflevector(a, b, 0, 1, 4, 5, 8, 9, 12, 13),
           (IntRegister)__builtin_shufflevector(a, b, 2, 3, 6, 7, 10, 11, 14, 15),
           (IntRegister)__builtin_shufflevector(c, d, 0, 1, 4, 5, 8, 9, 12, 13),
           (IntRegister)__builtin_shufflevector(c, d, 2, 3, 6, 7, 10, 11, 14, 15)}};
#elif defined(__AVX2__)
  return {{(IntRegister)__builtin_shufflevector((Quads)r.of[0], (Quads)r.of[1], 0, 1, 4, 5),
           (IntRegister)__builtin_shufflevector((Quads)r.of[0], (Quads)r.of[1], 2, 3, 6, 7)}};
#else
  return r;
#endif
}

/// Of the four rows of two records the differences hi - lo, but of the third the sums.
template <std::size_t part>
[[gnu::always_inline]] inline IntRegister against(const std::int32_t* lo, const std::int32_t* hi) {
  const Wrapping l = *reinterpret_cast<const Wrapping*>(lo + part * float_width),
                 h = *reinterpret_cast<const Wrapping*>(hi + part * float_width);
#if defined(__AVX512F__)
  return (IntRegister)_mm512_mask_add_epi32(_mm512_sub_epi32((__m512i)h, (__m512i)l), 0x0f00, (__m512i)h,
                                            (__m512i)l);
#elif defined(__AVX2__)
  if constexpr (part == 0) return (IntRegister)(h - l);
  return (IntRegister)(h +
                       (Wrapping)_mm256_sign_epi32((__m256i)l, _mm256_set_epi32(-1, -1, -1, -1, 1, 1, 1, 1)));
#else
  return (IntRegister)(part == 2 ? h + l : h - l);
#endif
}

/// A batch of pairs of records as `against` has them: {row 0, row 1, row 2, row 3}.
/// @param lo_of, hi_of  of a lane: the first of the sixteen integers of its end
template <class Rows, class LoOf, class HiOf>
[[gnu::always_inline]] inline Rows columns_of_ends(const LoOf& lo_of, const HiOf& hi_of) {
  constexpr std::size_t parts = 4 / quads;  // registers in a record
  Registers x[parts], y[parts], z[parts];
  const auto fetch = [&]<std::size_t part>() __attribute__((always_inline)) {
    for (std::size_t group = 0; group < quads; ++group) {
      const auto row = [&](std::size_t k) __attribute__((always_inline)) {
        return against<part>(lo_of(4 * group + k), hi_of(4 * group + k));
      };
      const Columns c = turned(row(0), row(1), row(2), row(3));
      x[part].of[group] = c.x, y[part].of[group] = c.y, z[part].of[group] = c.z;
    }
    x[part] = across(x[part]), y[part] = across(y[part]), z[part] = across(z[part]);
  };
  [&]<std::size_t... part>(std::index_sequence<part...>) __attribute__((always_inline)) {
    (fetch.template operator()<part>(), ...);
  }
  (std::make_index_sequence<parts>{});
  const auto column = [&](std::size_t row) __attribute__((always_inline)) {
    const std::size_t part = row / quads, lane = row % quads;
    return Vec<FloatLanes>{floats_of(x[part].of[lane]), floats_of(y[part].of[lane]),
                           floats_of(z[part].of[lane])};
  };
  return {column(0), column(1), column(2), column(3)};
}

/// Where store_load_rows puts the row of a lane.
constexpr std::size_t place_of_lane(std::size_t lane) { return lane % 4 * quads + lane / 4; }

struct Quartet {
  IntRegister of[4];
};

/// Of each lane a row [force, 0, moment, 0], in the order of place_of_lane.
/// @param as_kept  turns floats into what the sums are made of
template <class AsKept>
[[gnu::always_inline]] inline void store_load_rows(const Vec<FloatLanes>& force,
                                                   const Vec<FloatLanes>& moment, const AsKept& as_kept,
                                                   IntRow* rows) {
  const IntRegister zero{};
  const auto back = [&](const Vec<FloatLanes>& v) __attribute__((always_inline)) {
    const IntRegister x = as_kept(v.x), y = as_kept(v.y), z = as_kept(v.z);
    const IntRegister a = low_pairs(x, y, all_lanes), b = high_pairs(x, y, all_lanes);
    const IntRegister c = low_pairs(z, zero, all_lanes), d = high_pairs(z, zero, all_lanes);
    return Quartet{{low_halves(a, c, all_lanes), high_halves(a, c, all_lanes), low_halves(b, d, all_lanes),
                    high_halves(b, d, all_lanes)}};
  };
  const Quartet f = back(force), m = back(moment);
  auto* to = reinterpret_cast<IntRegister*>(rows);
  for (std::size_t j = 0; j < 4; ++j) {
#if defined(__AVX512F__)
    to[2 * j] =
        (IntRegister)__builtin_shufflevector((Quads)f.of[j], (Quads)m.of[j], 0, 1, 8, 9, 2, 3, 10, 11);
    to[2 * j + 1] =
        (IntRegister)__builtin_shufflevector((Quads)f.of[j], (Quads)m.of[j], 4, 5, 12, 13, 6, 7, 14, 15);
#elif defined(__AVX2__)
    to[2 * j] = (IntRegister)__builtin_shufflevector((Quads)f.of[j], (Quads)m.of[j], 0, 1, 4, 5);
    to[2 * j + 1] = (IntRegister)__builtin_shufflevector((Quads)f.of[j], (Quads)m.of[j], 2, 3, 6, 7);
#else
    to[2 * j] = f.of[j], to[2 * j + 1] = m.of[j];
#endif
  }
}

/// A row as the end `hi` takes it: the force turned round, the moment as it is.
[[gnu::always_inline]] inline IntRow on_hi(const IntRow& row) {
#if defined(__AVX2__)
  return (IntRow)_mm256_sign_epi32((__m256i)row, _mm256_set_epi32(1, 1, 1, 1, -1, -1, -1, -1));
#else
  constexpr std::uint32_t all = 0xffffffffu;
  const IntRow turns{all, all, all, all, 0, 0, 0, 0};
  return (row ^ turns) - turns;
#endif
}

}  // namespace
}  // namespace breccia::BRECCIA_ISA
