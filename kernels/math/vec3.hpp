// Vectors of three components, over doubles or over wide registers of doubles.
#pragma once
#include <cmath>
#include <type_traits>

namespace breccia {

/// Three components of any number type: `Vec<double>` for one particle, `Vec<simd>` for a batch of
/// them. One of doubles fills 32 bytes and is so aligned: it is one load, and never lies across two
/// lines of the cache.
template <class R>
struct alignas(std::is_same_v<R, double> ? 32 : alignof(R)) Vec {
  R x{}, y{}, z{};

  constexpr Vec& operator+=(const Vec& b) {
    x += b.x, y += b.y, z += b.z;
    return *this;
  }
  constexpr Vec& operator-=(const Vec& b) {
    x -= b.x, y -= b.y, z -= b.z;
    return *this;
  }
  bool operator==(const Vec&) const = default;
};

using Vec3 = Vec<double>;

template <class R>
constexpr Vec<R> operator+(const Vec<R>& a, const Vec<R>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class R>
constexpr Vec<R> operator-(const Vec<R>& a, const Vec<R>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class R>
constexpr Vec<R> operator-(const Vec<R>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class R>
constexpr Vec<R> operator*(const R& s, const Vec<R>& a) {
  return {s * a.x, s * a.y, s * a.z};
}

template <class R>
constexpr R dot(const Vec<R>& a, const Vec<R>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class R>
constexpr Vec<R> cross(const Vec<R>& a, const Vec<R>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }

}  // namespace breccia
