// Near pairs by cells against all pairs one by one.
#include <doctest/doctest.h>

#include <algorithm>
#include <random>

#include "core/geometry/cell_list.hpp"

using namespace breccia;

namespace {

struct Cloud {
  std::vector<Vec3> x;
  std::vector<double> r;
};

Cloud cloud(std::size_t n, const Vec3& extent, double least, double most, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> in(-0.5, 0.5), unit(0, 1);
  Cloud c;
  for (std::size_t k = 0; k < n; ++k) {
    c.x.push_back({extent.x * in(random), extent.y * in(random), extent.z * in(random)});
    c.r.push_back(least * std::pow(most / least, unit(random)));
  }
  return c;
}

using Pairs = std::vector<std::pair<Row, Row>>;

Pairs sorted(const std::vector<RowPair>& pairs) {
  Pairs all;
  for (const auto& [a, b] : pairs) all.emplace_back(a, b);
  std::sort(all.begin(), all.end());
  return all;
}

Pairs brute_force(const Cloud& c, double relative, double absolute) {
  Pairs all;
  for (Row a = 0; a < c.x.size(); ++a)
    for (Row b = a + 1; b < c.x.size(); ++b) {
      const double reach = (1 + relative) * (c.r[a] + c.r[b]) + absolute;
      const Vec3 d = c.x[b] - c.x[a];
      if (reach > 0 && dot(d, d) <= reach * reach) all.emplace_back(a, b);
    }
  return all;
}

void hold(const Cloud& c, std::initializer_list<std::pair<double, double>> reaches, std::size_t at_least) {
  for (const auto& [relative, absolute] : reaches) {
    const Pairs want = brute_force(c, relative, absolute);
    INFO("relative ", relative, ", absolute ", absolute, ", pairs ", want.size());
    CHECK(want.size() >= at_least);
    const auto one = near_pairs(c.x, c.r, relative, absolute, 1),
               three = near_pairs(c.x, c.r, relative, absolute, 3);
    CHECK(sorted(one) == want);
    CHECK(sorted(three) == want);
  }
}

}  // namespace

TEST_CASE(
    "cell list: random spheres, sizes 1 to 6, relative and absolute reach, threads 1 and 3 [brute force, "
    "equal]") {
  const Cloud c = cloud(1500, {1, 0.7, 2}, 0.01, 0.06, 1);
  hold(c, {{0, 0}, {0.1, 0}, {0, 0.02}, {0.3, 0.01}, {-0.3, 0}, {-0.9, 0.02}, {0, -0.01}, {-0.5, -0.005}}, 5);
}

TEST_CASE(
    "cell list: fragments that have flown far, flat and thin clouds, all in one place [brute force, equal]") {
  Cloud far = cloud(1200, {1, 1, 1}, 0.02, 0.04, 2);
  far.x[3] = {1e4, 0, 0};
  far.x[4] = {1e4 + 0.03, 0, 0};
  far.x[5] = {0, -3e5, 2e6};
  hold(far, {{0.1, 0}, {0, 0.01}}, 100);
  hold(cloud(800, {1, 1, 0}, 0.01, 0.03, 3), {{0.1, 0}}, 100);
  hold(cloud(800, {0, 0, 1}, 0.001, 0.002, 4), {{0.1, 0}}, 100);
  hold(cloud(40, {0, 0, 0}, 0.01, 0.03, 5), {{0, 0}}, 40 * 39 / 2);
}

TEST_CASE("cell list: few and no spheres, spheres just inside and just outside the reach [exact]") {
  CHECK(near_pairs({}, {}, 0.1, 0, 2).empty());
  hold(cloud(1, {1, 1, 1}, 0.1, 0.2, 6), {{0.1, 0}}, 0);
  Cloud c;
  for (int k = 0; k < 600; ++k)
    c.x.push_back({k % 2 ? 2.0 * (k / 2) + 1.0001 : 2.0 * (k / 2), 0, 0}), c.r.push_back(0.5);
  CHECK(near_pairs(c.x, c.r, 0, 0, 3).size() == 299);     // pairs 0.9999 apart
  CHECK(near_pairs(c.x, c.r, 2e-4, 0, 3).size() == 599);  // and those 1.0001 apart
  CHECK(near_pairs(c.x, c.r, 0.9e-4, 0, 3).size() == 299);
  CHECK(near_pairs(c.x, c.r, 0, 1.1e-4, 3).size() == 599);
}

TEST_CASE("cell list: the order of the pairs depends on positions only [equal]") {
  const Cloud c = cloud(1500, {1, 1, 1}, 0.02, 0.04, 7);
  const auto one = near_pairs(c.x, c.r, 0.1, 0, 1);
  for (const int threads : {2, 3, 5}) CHECK(near_pairs(c.x, c.r, 0.1, 0, threads) == one);
}
