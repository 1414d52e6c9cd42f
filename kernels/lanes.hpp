// The few operations a law needs that differ between one number and a wide register of them. A law is written
// once, over a number type R: double in tests, std::experimental::simd in the production loop.
#pragma once
#include <cmath>
#include <type_traits>

#include "kernels/vec3.hpp"

namespace breccia {

/// True when the condition holds in at least one lane.
template <class Mask>
inline bool any(const Mask& m) {
  if constexpr (std::is_same_v<Mask, bool>)
    return m;
  else
    return any_of(m);  // found by argument: std::experimental::any_of
}

/// Lane by lane: m ? a : b.
template <class Mask, class R>
inline R select(const Mask& m, const R& a, const R& b) {
  if constexpr (std::is_same_v<Mask, bool>) {
    return m ? a : b;
  } else {
    R r = b;
    where(m, r) = a;
    return r;
  }
}

template <class Mask, class R>
inline Vec<R> select(const Mask& m, const Vec<R>& a, const Vec<R>& b) {
  return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
}

template <class R>
inline R larger(const R& a, const R& b) {
  return select(a > b, a, b);
}
template <class R>
inline R smaller(const R& a, const R& b) {
  return select(a < b, a, b);
}

template <class R>
inline R square_root(const R& a) {
  using std::sqrt;
  return sqrt(a);
}

/// exp(x) for |x| of a few, to some units in the last place: Taylor's series of x/16, squared four times. No
/// call to the maths library, so it stays in the register.
template <class R>
inline R exponential(const R& x) {
  const R y = R(1.0 / 16.0) * x;
  R sum(1.0);
  for (int n = 13; n > 0; --n) sum = R(1.0) + (R(1.0 / n) * y) * sum;
  for (int k = 0; k < 4; ++k) sum = sum * sum;
  return sum;
}

}  // namespace breccia
