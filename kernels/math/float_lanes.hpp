// A register of floats as laws take it: a number type that is made from a double. The laws are
// written once, over R; here R is sixteen floats where it is eight doubles in the loop in double
// precision. Included by files that are compiled per instruction set only.
#pragma once
#include <cstdint>
#include <experimental/simd>

#include "kernels/math/lanes.hpp"

namespace breccia::BRECCIA_ISA {
namespace {

struct FloatLanes {
  using Register = std::experimental::native_simd<float>;
  using Mask = Register::mask_type;
  using value_type = float;

  FloatLanes() = default;
  FloatLanes(const Register& lanes) : v(lanes) {}
  FloatLanes(double all) : v(static_cast<float>(all)) {}
  template <class ValueOf>
  requires std::is_invocable_v<ValueOf, std::integral_constant<std::size_t, 0>>
  explicit FloatLanes(const ValueOf& value_of) : v(value_of) {}

  static constexpr std::size_t size() { return Register::size(); }
  float operator[](std::size_t lane) const { return v[lane]; }

  [[gnu::always_inline]] friend FloatLanes operator+(const FloatLanes& a, const FloatLanes& b) {
    return a.v + b.v;
  }
  [[gnu::always_inline]] friend FloatLanes operator-(const FloatLanes& a, const FloatLanes& b) {
    return a.v - b.v;
  }
  [[gnu::always_inline]] friend FloatLanes operator*(const FloatLanes& a, const FloatLanes& b) {
    return a.v * b.v;
  }
  [[gnu::always_inline]] friend FloatLanes operator/(const FloatLanes& a, const FloatLanes& b) {
    return a.v / b.v;
  }
  [[gnu::always_inline]] friend FloatLanes operator-(const FloatLanes& a) { return -a.v; }
  FloatLanes& operator+=(const FloatLanes& b) { return *this = *this + b; }
  FloatLanes& operator-=(const FloatLanes& b) { return *this = *this - b; }
  FloatLanes& operator*=(const FloatLanes& b) { return *this = *this * b; }
  [[gnu::always_inline]] friend Mask operator<(const FloatLanes& a, const FloatLanes& b) { return a.v < b.v; }
  [[gnu::always_inline]] friend Mask operator>(const FloatLanes& a, const FloatLanes& b) { return a.v > b.v; }
  [[gnu::always_inline]] friend Mask operator<=(const FloatLanes& a, const FloatLanes& b) {
    return a.v <= b.v;
  }
  [[gnu::always_inline]] friend Mask operator>=(const FloatLanes& a, const FloatLanes& b) {
    return a.v >= b.v;
  }
  [[gnu::always_inline]] friend Mask operator==(const FloatLanes& a, const FloatLanes& b) {
    return a.v == b.v;
  }
  [[gnu::always_inline]] friend Mask operator!=(const FloatLanes& a, const FloatLanes& b) {
    return a.v != b.v;
  }
  [[gnu::always_inline]] friend FloatLanes sqrt(const FloatLanes& a) { return std::experimental::sqrt(a.v); }
  [[gnu::always_inline]] friend FloatLanes magnitude(const FloatLanes& a) {
    return std::experimental::abs(a.v);
  }

  Register v;
};

/// Found before the one for any number type, which would need a `where` for this one.
[[gnu::always_inline]] inline FloatLanes select(const FloatLanes::Mask& m, const FloatLanes& a,
                                                const FloatLanes& b) {
  FloatLanes::Register r = b.v;
  where(m, r) = a.v;
  return r;
}

[[gnu::always_inline]] inline double sum_of_lanes(const FloatLanes& a) {
  return static_cast<double>(std::experimental::reduce(a.v));
}

inline constexpr std::size_t float_width = FloatLanes::size();
using IntRegister [[gnu::vector_size(4 * float_width), gnu::may_alias]] = std::int32_t;
using FloatRegister [[gnu::vector_size(4 * float_width)]] = float;

[[gnu::always_inline]] inline FloatLanes floats_of(const IntRegister& a) {
  return std::bit_cast<FloatLanes::Register>(__builtin_convertvector(a, FloatRegister));
}

/// To the nearest; what no integer holds becomes the smallest one.
[[gnu::always_inline]] inline IntRegister nearest_integers(const FloatLanes& a) {
#if defined(__AVX512F__)
  return (IntRegister)__builtin_ia32_cvtps2dq512_mask(std::bit_cast<FloatRegister>(a.v), IntRegister{},
                                                      static_cast<unsigned short>(-1), 4);
#elif defined(__AVX__)
  return (IntRegister)__builtin_ia32_cvtps2dq256(std::bit_cast<FloatRegister>(a.v));
#else
  return (IntRegister)__builtin_ia32_cvtps2dq(std::bit_cast<FloatRegister>(a.v));
#endif
}

}  // namespace
}  // namespace breccia::BRECCIA_ISA
