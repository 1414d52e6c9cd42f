#include "core/geometry/space_curve.hpp"

#include <algorithm>
#include <array>

namespace breccia {
namespace {

constexpr int bits = 21;

/// Skilling's inverse undo and Gray encoding, then the bits of the three axes interleaved.
std::uint64_t hilbert_index(std::array<std::uint32_t, 3> x) {
  const std::uint32_t top = 1u << (bits - 1);
  for (std::uint32_t q = top; q > 1; q >>= 1) {
    const std::uint32_t p = q - 1;
    for (auto& axis : x) {
      if (axis & q) {
        x[0] ^= p;
      } else {
        const std::uint32_t t = (x[0] ^ axis) & p;
        x[0] ^= t;
        axis ^= t;
      }
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t t = 0;
  for (std::uint32_t q = top; q > 1; q >>= 1)
    if (x[2] & q) t ^= q - 1;
  for (auto& axis : x) axis ^= t;
  std::uint64_t key = 0;
  for (int bit = bits - 1; bit >= 0; --bit)
    for (const auto axis : x) key = key << 1 | ((axis >> bit) & 1u);
  return key;
}

}  // namespace

std::vector<std::uint64_t> hilbert_keys(std::span<const Vec3> points) {
  std::vector<std::uint64_t> keys(points.size());
  if (points.empty()) return keys;
  Vec3 low = points[0], high = points[0];
  for (const Vec3& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const Vec3 extent = high - low;
  const double side = std::max({extent.x, extent.y, extent.z, 1e-300});
  const double cells = (1u << bits) - 1;
  const auto cell = [&](double at, double from) {
    return static_cast<std::uint32_t>((at - from) / side * cells);
  };
  for (std::size_t k = 0; k < points.size(); ++k)
    keys[k] = hilbert_index({cell(points[k].x, low.x), cell(points[k].y, low.y), cell(points[k].z, low.z)});
  return keys;
}

}  // namespace breccia
