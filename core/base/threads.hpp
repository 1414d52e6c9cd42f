// Threads: every loop of the step is cut into as many contiguous ranges as there are threads, and
// TBB runs them. Which thread runs which range does not matter to any result.
#pragma once
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#if defined(__SANITIZE_THREAD__)
extern "C" {
void __tsan_acquire(void*);
void __tsan_release(void*);
}
#endif

namespace breccia {

/// Calls work(k) for k = 0 ... tasks - 1, in any order on TBB's threads; returns when all are done.
template <class Index, class Work, class Partitioner = tbb::auto_partitioner>
void for_tasks(Index tasks, const Work& work, const Partitioner& partitioner = {}) {
#if defined(__SANITIZE_THREAD__)
  // Debian's TBB is not instrumented: the thread sanitizer is told of its fork and join. Statics,
  // and the task made before the fork: nothing of the task may be read before it has said that it
  // has begun
  static char fork = 0, join = 0;
  const auto task = [&work](Index k) {
    __tsan_acquire(&fork);
    work(k);
    __tsan_release(&join);
  };
  __tsan_release(&fork);
  tbb::parallel_for(Index{0}, tasks, Index{1}, task, partitioner);
  __tsan_acquire(&join);
#else
  tbb::parallel_for(Index{0}, tasks, Index{1}, work, partitioner);
#endif
}

/// Calls work(range) for range = 0 ... ranges - 1, on as many threads.
template <class Work>
void for_ranges(int ranges, const Work& work) {
  if (ranges <= 1)
    work(0);
  else
    for_tasks(ranges, work, tbb::simple_partitioner{});
}

/// Sorts in the order of `<`, on all threads that TBB has.
template <class Iterator>
void sort_on_threads(Iterator first, Iterator last) {
#if defined(__SANITIZE_THREAD__)
  std::sort(first, last);  // the sanitizer does not see TBB's forks and joins
#else
  tbb::parallel_sort(first, last);
#endif
}

/// First row of a range when `rows` are cut into `ranges` parts that are multiples of `batch` but
/// for the last.
inline std::size_t range_first(std::size_t rows, int range, int ranges, std::size_t batch = 1) {
  const std::size_t batches = (rows + batch - 1) / batch;
  return std::min(rows, batches * static_cast<std::size_t>(range) / static_cast<std::size_t>(ranges) * batch);
}

/// Calls work(first, last) for one contiguous range of rows per thread.
template <class Work>
void for_rows(std::size_t rows, int ranges, const Work& work) {
  constexpr std::size_t worth_a_thread = 2048;
  if (rows < worth_a_thread) ranges = 1;
  for_ranges(ranges, [&](int k) { work(range_first(rows, k, ranges), range_first(rows, k + 1, ranges)); });
}

/// Sum of term(row) over rows [0, rows), added in blocks of fixed size: the same bits for any
/// number of threads. T needs +=; `block_sums` is storage kept between calls.
template <class T, class Term>
T sum_rows(std::size_t rows, int ranges, std::vector<T>& block_sums, const Term& term) {
  constexpr std::size_t block = 1024;
  const std::size_t blocks = (rows + block - 1) / block;
  block_sums.assign(blocks, T{});
  const int parts = blocks < 4 ? 1 : ranges;  // a few thousand rows are not worth a thread
  for_ranges(parts, [&](int range) {
    for (std::size_t b = range_first(blocks, range, parts); b < range_first(blocks, range + 1, parts); ++b) {
      T sum{};
      for (std::size_t row = b * block; row < std::min(rows, (b + 1) * block); ++row) sum += term(row);
      block_sums[b] = sum;
    }
  });
  T total{};
  for (const T& sum : block_sums) total += sum;
  return total;
}

}  // namespace breccia
