// The Hilbert curve that orders the particles.
#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "core/geometry/space_curve.hpp"

using namespace breccia;

namespace {

std::vector<std::size_t> order_of(const std::vector<std::uint64_t>& keys) {
  std::vector<std::size_t> order(keys.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });
  return order;
}

}  // namespace

TEST_CASE(
    "space curve: through an 8 x 8 x 8 grid it visits each cell once and steps to a face neighbour "
    "[Skilling, exact]") {
  std::vector<Vec3> points;
  for (int x = 0; x < 8; ++x)
    for (int y = 0; y < 8; ++y)
      for (int z = 0; z < 8; ++z) points.push_back({double(x), double(y), double(z)});
  std::shuffle(points.begin(), points.end(), std::mt19937_64(4));
  const auto keys = hilbert_keys(points);
  const auto order = order_of(keys);
  int neighbours = 0;
  for (std::size_t k = 1; k < order.size(); ++k) {
    CHECK_MESSAGE(keys[order[k]] > keys[order[k - 1]], "keys differ");
    neighbours += norm(points[order[k]] - points[order[k - 1]]) == 1.0;
  }
  CHECK(neighbours == 511);
}

TEST_CASE(
    "space curve: neighbours in order are neighbours in space: mean step 1.6 spacings at most, keys are a "
    "permutation") {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> in(-1, 1);
  std::vector<Vec3> points;
  for (int k = 0; k < 8000; ++k) points.push_back({in(random), 0.5 * in(random), 2 * in(random)});
  auto keys = hilbert_keys(points);
  const auto order = order_of(keys);
  double length = 0;
  for (std::size_t k = 1; k < order.size(); ++k) length += norm(points[order[k]] - points[order[k - 1]]);
  const double spacing = std::cbrt(8.0 * 1 * 0.5 * 2 / 8000);
  CHECK(length / 8000 < 1.6 * spacing);  // a random order: 23 spacings
  std::sort(keys.begin(), keys.end());
  CHECK(std::adjacent_find(keys.begin(), keys.end()) == keys.end());
  CHECK(keys.back() < (std::uint64_t{1} << 63));
}

TEST_CASE("space curve: no points, one, and all in one place [exact]") {
  CHECK(hilbert_keys({}).empty());
  const std::vector<Vec3> same(3, Vec3{1, 2, 3});
  CHECK(hilbert_keys(same) == std::vector<std::uint64_t>(3, 0));
}

TEST_CASE("space curve: shifted and scaled points keep their order [exact powers of two]") {
  std::mt19937_64 random(9);
  std::uniform_int_distribution<int> cell(0, 1023);
  std::vector<Vec3> points{{0, 0, 0}, {1023, 1023, 1023}}, other;
  for (int k = 0; k < 500; ++k)
    points.push_back({double(cell(random)), double(cell(random)), double(cell(random))});
  for (const Vec3& p : points) other.push_back(0.25 * p + Vec3{-64, 8, 32});
  CHECK(hilbert_keys(other) == hilbert_keys(points));
}
