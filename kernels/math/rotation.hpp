// Rotations as vectors: along the axis, as long as the angle.
#pragma once
#include <cmath>

#include "kernels/math/vec3.hpp"

namespace breccia {

/// The rotation `first` followed by `then`, both rotation vectors in rad; of an angle up to pi.
inline Vec3 followed_by(const Vec3& first, const Vec3& then) {
  struct Quaternion {
    double w;
    Vec3 v;
  };
  const auto quaternion = [](const Vec3& r) -> Quaternion {
    const double angle = norm(r), half = 0.5 * angle;
    // sin(half)/angle goes to 1/2
    return {std::cos(half), (angle > 1e-8 ? std::sin(half) / angle : 0.5 - half * half / 12.0) * r};
  };
  const Quaternion a = quaternion(then), b = quaternion(first);
  const double w = a.w * b.w - dot(a.v, b.v);
  const Vec3 v = a.w * b.v + b.w * a.v + cross(a.v, b.v);
  const double sine = norm(v), sense = w < 0.0 ? -1.0 : 1.0;
  if (!(sine > 1e-300)) return {};
  return (sense * 2.0 * std::atan2(sine, std::abs(w)) / sine) * v;
}

}  // namespace breccia
