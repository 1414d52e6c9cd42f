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
    using reference = T&;
    using pointer = T*;
    using difference_type = std::ptrdiff_t;
    using iterator_category = std::forward_iterator_tag;
    Iterator() = default;
    Iterator(T* at, std::size_t stride) : at_(at), stride_(stride) {}
    T& operator*() const { return *at_; }
    Iterator& operator++() {
      at_ += stride_;
      return *this;
    }
    Iterator operator++(int) {
      const Iterator before = *this;
      ++*this;
      return before;
    }
    bool operator==(const Iterator& other) const { return at_ == other.at_; }

  private:
    T* at_ = nullptr;
    std::size_t stride_ = 1;
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
  Iterator begin() const { return {first_, stride_}; }
  Iterator end() const { return {first_ + size_ * stride_, stride_}; }

private:
  T* first_ = nullptr;
  std::size_t size_ = 0, stride_ = 1;
};

}  // namespace breccia
