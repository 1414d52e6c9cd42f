// What a rank owns of a world: a contiguous part of the rows of particles, which lie along a
// space-filling curve, and the bonds whose lower row is among them. Rows mean the same on every
// rank.
//
// Sums over particles, bonds or lists of rows are taken block of rows by block of rows, then over
// the blocks in their order. Ranks own whole blocks, so that a sum has the same bits for any number
// of ranks and threads.
#pragma once
#include <algorithm>
#include <vector>

#include "core/base/threads.hpp"
#include "core/ranks/mpi.hpp"
#include "core/tables/bond_table.hpp"

namespace breccia {

/// Rows [first, last).
struct Rows {
  std::size_t first = 0, last = 0;
};

struct Partition {
  Ranks ranks;
  std::size_t rows = 0;             ///< of particles, on all ranks
  std::size_t block = 64;           ///< rows of a block
  std::vector<std::size_t> bounds;  ///< rank r owns rows [bounds[r], bounds[r + 1]); multiples of `block`
  std::vector<Neighbour> neighbours;
  /// Of several ranks, per block of bonds: true where one ends in another's part.
  std::vector<char> interface_blocks;

  Rows owned() const {
    const auto r = static_cast<std::size_t>(ranks.rank);
    return {bounds[r], bounds[r + 1]};
  }
  /// Those of [first, last) that are owned.
  Rows owned(std::size_t first, std::size_t last) const {
    const Rows mine = owned();
    const std::size_t begin = std::clamp(mine.first, first, last);
    return {begin, std::clamp(mine.last, begin, last)};
  }
  int owner(std::size_t row) const {
    return static_cast<int>(std::upper_bound(bounds.begin(), bounds.end(), row) - bounds.begin()) - 1;
  }
};

/// Everything belongs to the one rank that there is.
Partition serial_partition(std::size_t rows);

/// Of one of several ranks: parts of equal work, neighbours not yet met.
Partition partition_of_rank(std::size_t rows, const BondTable& bonds, const Ranks& ranks);

/// (B95): sum over the items of all ranks, block by block. T needs += and is copied as it lies.
/// @param first_at  item with which the given row begins; rises with the row
/// @param blocks    storage that is kept between calls
/// @param over      over(first, last): the sum over these items, in their order
template <class T, class First, class Over>
T sum_blocks(const Partition& s, int threads, std::vector<T>& blocks, const First& first_at,
             const Over& over) {
  const auto block_at = [&](std::size_t row) { return (row + s.block - 1) / s.block; };
  const Rows mine = s.owned();
  const std::size_t begin = block_at(mine.first), end = block_at(mine.last);
  blocks.assign(block_at(s.rows), T{});
  const int parts = end - begin < 32 ? 1 : threads;  // a few thousand rows are not worth a thread
  for_ranges(parts, [&](int part) {
    const std::size_t last_block = begin + range_first(end - begin, part + 1, parts);
    for (std::size_t b = begin + range_first(end - begin, part, parts); b < last_block; ++b) {
      blocks[b] = over(first_at(b * s.block), first_at(std::min((b + 1) * s.block, s.rows)));
    }
  });
  if (!s.ranks.alone()) {
    std::vector<std::size_t> bytes;
    for (std::size_t r = 0; r + 1 < s.bounds.size(); ++r)
      bytes.push_back((block_at(s.bounds[r + 1]) - block_at(s.bounds[r])) * sizeof(T));
    const std::vector<T> own(blocks.begin() + static_cast<std::ptrdiff_t>(begin),
                             blocks.begin() + static_cast<std::ptrdiff_t>(end));
    all_gather(s.ranks, own.data(), bytes, blocks.data());
  }
  T total{};
  for (const T& sum : blocks) total += sum;
  return total;
}

/// Sums term(item) over a range of items.
template <class T, class Term>
auto each(const Term& term) {
  return [&term](std::size_t first, std::size_t last) {
    T sum{};
    for (std::size_t item = first; item < last; ++item) sum += term(item);
    return sum;
  };
}

/// Over all rows of particles.
template <class T, class Term>
T sum_particles(const Partition& s, int threads, std::vector<T>& blocks, const Term& term) {
  return sum_blocks(
      s, threads, blocks, [](std::size_t row) { return row; }, each<T>(term));
}

/// The same, range by range: over(first, last).
template <class T, class Over>
T sum_particle_ranges(const Partition& s, int threads, std::vector<T>& blocks, const Over& over) {
  return sum_blocks(
      s, threads, blocks, [](std::size_t row) { return row; }, over);
}

/// Over a list of rows, rising; term is called with places in the list.
template <class T, class Term>
T sum_listed(const Partition& s, std::span<const Row> list, int threads, std::vector<T>& blocks,
             const Term& term) {
  const auto first_at = [&](std::size_t row) {
    return static_cast<std::size_t>(std::lower_bound(list.begin(), list.end(), row) - list.begin());
  };
  return sum_blocks(s, threads, blocks, first_at, each<T>(term));
}

/// Calls work with the places in a list of rising rows that are owned.
template <class Work>
void for_owned_entries(const Partition& s, std::span<const Row> list, const Work& work) {
  const Rows mine = s.owned();
  const auto at = [&](std::size_t row) {
    return static_cast<std::size_t>(std::lower_bound(list.begin(), list.end(), row) - list.begin());
  };
  for (std::size_t k = at(mine.first); k < at(mine.last); ++k) work(k);
}

/// The owned ones of values that stand beside such a list, at the root.
template <class T>
std::vector<T> gather_owned_entries(const Partition& s, std::span<const Row> list,
                                    std::span<const T> values) {
  std::vector<T> mine;
  for_owned_entries(s, list, [&](std::size_t k) { mine.push_back(values[k]); });
  return gather_elements(s.ranks, std::span<const T>(mine));
}

/// Over the owned bonds or contacts of a table, sorted by the lower row of their ends, range by
/// range: over(first, last).
template <class T, class Table, class Over>
T sum_pair_ranges(const Partition& s, const Table& t, int threads, std::vector<T>& blocks, const Over& over) {
  const auto first_at = [&](std::size_t row) {
    std::size_t low = 0, high = t.size;
    while (low < high) {
      const std::size_t middle = (low + high) / 2;
      const bool before = std::min<std::size_t>(t.row_lo[middle], t.row_hi[middle]) < row;
      before ? low = middle + 1 : high = middle;
    }
    return low;
  };
  return sum_blocks(s, threads, blocks, first_at, over);
}

/// The same, one by one: term(row).
template <class T, class Table, class Term>
T sum_pairs(const Partition& s, const Table& t, int threads, std::vector<T>& blocks, const Term& term) {
  return sum_pair_ranges(s, t, threads, blocks, each<T>(term));
}

}  // namespace breccia
