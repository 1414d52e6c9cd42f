// How a column lies in memory.
#pragma once
#include <cstddef>
#include <new>
#include <vector>

namespace breccia {

/// Long columns begin at a page of memory: the loop over bonds goes through more than a dozen of
/// them at the same row, and then crosses lines of the cache, and pages, in all of them at once
/// (data/performance).
template <class T>
struct PageAllocator {
  using value_type = T;
  static constexpr std::size_t page = 4096;  ///< B

  PageAllocator() = default;
  template <class Other>
  PageAllocator(const PageAllocator<Other>&) {}

  static constexpr std::align_val_t alignment(std::size_t count) {
    return std::align_val_t{count * sizeof(T) >= 4 * page ? page : alignof(T)};
  }
  T* allocate(std::size_t count) {
    return static_cast<T*>(::operator new(count * sizeof(T), alignment(count)));
  }
  void deallocate(T* at, std::size_t count) { ::operator delete(at, alignment(count)); }

  bool operator==(const PageAllocator&) const = default;
};

template <class T>
using Column = std::vector<T, PageAllocator<T>>;

}  // namespace breccia
