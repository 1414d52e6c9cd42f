// Values at a fixed distance in memory: one quantity of rows that lie together with others in
// records.
#pragma once
#include <cstddef>
#include <iterator>
#include <ranges>

namespace breccia {

/// As std::span, with `stride` values of T from each to the next: 1 for a column of its own.
template <class T>
class Strided {
public:
  class Iterator {
  public:
    using value_type = std::remove_const_t<T>;
    using difference_type = std::ptrdiff_t;
    Iterator() = default;
    Iterator(const Strided& values, std::size_t row) : values_(values), row_(row) {}
    T& operator*() const { return values_[row_]; }
    Iterator& operator++() {
      ++row_;
      return *this;
    }
    Iterator operator++(int) {
      const Iterator before = *this;
      ++*this;
      return before;
    }
    bool operator==(const Iterator& other) const { return row_ == other.row_; }

  private:
    Strided values_;
    std::size_t row_ = 0;
  };

  constexpr Strided() = default;
  constexpr Strided(T* first, std::size_t size, std::size_t stride)
      : first_(first), size_(size), stride_(stride) {}
  template <std::ranges::contiguous_range Values>
  requires std::convertible_to<decltype(std::ranges::data(std::declval<Values&>())), T*>
  constexpr Strided(Values&& values)
      : first_(std::ranges::data(values)), size_(std::ranges::size(values)), stride_(1) {}
  constexpr operator Strided<const T>() const requires(!std::is_const_v<T>) {
    return {first_, size_, stride_};
  }

  constexpr T& operator[](std::size_t row) const { return first_[row * stride_]; }
  constexpr std::size_t size() const { return size_; }
  constexpr bool empty() const { return size_ == 0; }
  constexpr T* data() const { return first_; }
  constexpr std::size_t stride() const { return stride_; }
  constexpr Strided first(std::size_t rows) const { return {first_, rows, stride_}; }
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, size_}; }

private:
  T* first_ = nullptr;
  std::size_t size_ = 0, stride_ = 1;
};

}  // namespace breccia
