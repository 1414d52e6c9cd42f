#include "core/ranks/partition.hpp"

#include <numeric>

namespace breccia {
namespace {

std::size_t rows_of_block(std::size_t rows) {
  return std::clamp<std::size_t>((rows / 2048 + 63) / 64 * 64, 64, 1024);
}

/// Cuts rows into parts of equal work, at blocks; work: bonds, and a little for the particle
/// itself.
std::vector<std::size_t> equal_parts(std::size_t n, const BondTable& bonds, std::size_t block, int count) {
  std::vector<double> work((n + block - 1) / block, 0.0);
  for (std::size_t row = 0; row < n; ++row) work[row / block] += 1.0;
  for (std::size_t k = 0; k < bonds.size; ++k)
    work[std::min(bonds.row_lo[k], bonds.row_hi[k]) / block] += 1.0;
  const double total = std::accumulate(work.begin(), work.end(), 0.0);
  std::vector<std::size_t> bounds{0};
  double sum = 0.0;
  for (std::size_t b = 0; b < work.size(); ++b) {
    // a block goes to the part in which its middle lies
    const double wanted = total * static_cast<double>(bounds.size()) / count;
    if (static_cast<int>(bounds.size()) < count && b > 0 && sum + 0.5 * work[b] > wanted)
      bounds.push_back(b * block);
    sum += work[b];
  }
  bounds.resize(static_cast<std::size_t>(count), n);  // more ranks than blocks: the last have nothing
  bounds.push_back(n);
  return bounds;
}

}  // namespace

Partition serial_partition(std::size_t rows) {
  Partition s;
  s.rows = rows;
  s.block = rows_of_block(rows);
  s.bounds = {0, rows};
  return s;
}

Partition partition_of_rank(std::size_t rows, const BondTable& bonds, const Ranks& ranks) {
  Partition s = serial_partition(rows);
  s.ranks = ranks;
  s.bounds = equal_parts(rows, bonds, s.block, ranks.count);
  return s;
}

}  // namespace breccia
