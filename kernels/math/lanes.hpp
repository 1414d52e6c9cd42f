// The few operations a law needs that differ between one number and a wide register of them. A law
// is written once, over a number type R: double in tests, std::experimental::simd in the production
// loop.
#pragma once
#include <cmath>
#include <type_traits>

#include "kernels/math/vec3.hpp"

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

/// 1/x, to an ulp; without a division where every lane is within 1e-4 of 1. A lane's value does not
/// depend on its neighbours.
template <class R>
inline R inverse_near_one(const R& x) {
  const R one(1.0), e = one - x, e2 = e * e;
  R y = (one + e) + e2 * (one + e);
  const auto far = e2 > R(1e-8);
  if (any(far)) y = select(far, one / x, y);
  return y;
}

/// 1/sqrt(x) in the same way.
template <class R>
inline R inverse_root_near_one(const R& x) {
  const R one(1.0), e = one - x, e2 = e * e;
  R y = (one + R(1.0 / 2) * e) + e2 * (R(3.0 / 8) + R(5.0 / 16) * e);
  const auto far = e2 > R(1e-8);
  if (any(far)) y = select(far, one / square_root(x), y);
  return y;
}

/// exp(x) for |x| of a few, to some units in the last place: Taylor's series of x/16, squared four
/// times. No call to the maths library, so it stays in the register.
template <class R>
inline R exponential(const R& x) {
  const R y = R(1.0 / 16.0) * x;
  R sum(1.0);
  for (int n = 13; n > 0; --n) sum = R(1.0) + (R(1.0 / n) * y) * sum;
  for (int k = 0; k < 4; ++k) sum = sum * sum;
  return sum;
}

}  // namespace breccia
