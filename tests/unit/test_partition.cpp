// The parts of ranks, and sums that do not depend on them. Ranks that talk to each other:
// tests/cli/test_ranks.py.
#include <doctest/doctest.h>

#include <cmath>

#include "core/ranks/partition.hpp"
#include "core/world/make_world.hpp"
#include "tests/scene.hpp"

using namespace breccia;

namespace {

World small_world() {
  const reference::Parameters p;
  const Assembly a = assemble(scene::small_packing(500), scene::small_cylinder(), {}, Features{}, 1);
  return make_world(a, scene::material_of(p), scene::factor(p), {});
}

}  // namespace

TEST_CASE("partition: ranks own whole blocks, all rows once, and the same work to within a block") {
  const World w = small_world();
  for (const int count : {1, 2, 3, 5, 40}) {
    std::size_t rows = 0;
    for (int rank = 0; rank < count; ++rank) {
      const Partition s = partition_of_rank(w.particles.size, w.bonds, {rank, count});
      REQUIRE(s.bounds.size() == static_cast<std::size_t>(count) + 1);
      CHECK(s.bounds.front() == 0);
      CHECK(s.bounds.back() == w.particles.size);
      const Rows own = s.owned();
      CHECK((own.first % s.block == 0 || own.first == w.particles.size));
      for (std::size_t row = own.first; row < own.last; ++row) CHECK(s.owner(row) == rank);
      rows += own.last - own.first;
    }
    CHECK(rows == w.particles.size);
  }
  const Partition s = partition_of_rank(w.particles.size, w.bonds, {0, 2});
  std::size_t work[2] = {0, 0};
  for (std::size_t k = 0; k < w.bonds.size; ++k)
    ++work[s.owner(std::min(w.bonds.row_lo[k], w.bonds.row_hi[k]))];
  CHECK(std::abs(static_cast<double>(work[0]) - static_cast<double>(work[1])) <
        12.0 * static_cast<double>(s.block));
}

TEST_CASE("partition: owned rows of a part are those of both") {
  Partition s = serial_partition(1000);
  s.bounds = {0, 128, 640, 1000};
  s.ranks = {1, 3};
  CHECK(s.owned(0, 100).first == s.owned(0, 100).last);
  CHECK((s.owned(0, 200).first == 128 && s.owned(0, 200).last == 200));
  CHECK((s.owned(600, 900).first == 600 && s.owned(600, 900).last == 640));
  CHECK(s.owned(700, 900).first == s.owned(700, 900).last);
}

TEST_CASE("sums: the same bits for any number of threads, and rows, lists and pairs counted once") {
  const World w = small_world();
  const auto term = [](std::size_t k) {
    return std::sin(1.0 + static_cast<double>(k)) * std::pow(10.0, k % 17);
  };
  std::vector<double> blocks;
  std::vector<Row> list;
  for (Row row = 0; row < w.particles.size; row += 3) list.push_back(row);
  const double rows = sum_particles(w.partition, 1, blocks, term),
               listed = sum_listed(w.partition, list, 1, blocks, term),
               pairs = sum_pairs(w.partition, w.bonds, 1, blocks, term);
  for (const int threads : {2, 3, 7}) {
    CHECK(sum_particles(w.partition, threads, blocks, term) == rows);
    CHECK(sum_listed(w.partition, list, threads, blocks, term) == listed);
    CHECK(sum_pairs(w.partition, w.bonds, threads, blocks, term) == pairs);
  }
  const auto one = [](std::size_t) { return 1.0; };
  CHECK(sum_particles(w.partition, 1, blocks, one) == static_cast<double>(w.particles.size));
  CHECK(sum_listed(w.partition, list, 1, blocks, one) == static_cast<double>(list.size()));
  CHECK(sum_pairs(w.partition, w.bonds, 2, blocks, one) == static_cast<double>(w.bonds.size));
  std::size_t entries = 0;
  for_owned_entries(w.partition, list, [&](std::size_t k) { CHECK(k == entries++); });
  CHECK(entries == list.size());
}
