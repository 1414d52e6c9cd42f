// How many operations the law takes for a bond, found by running it on numbers that count.
#pragma once
#include <cmath>
#include <cstddef>

#include "kernels/math/vec3.hpp"

namespace breccia {

struct OperationCount {
  std::size_t additions = 0;  ///< and subtractions
  std::size_t multiplications = 0, divisions = 0, roots = 0, comparisons = 0;
  /// Additions, multiplications, divisions and roots, one each, whatever they cost; a comparison
  /// takes no place in the units that add and multiply.
  std::size_t total() const { return additions + multiplications + divisions + roots; }
};

/// A double that counts what is done to it. A change of sign is not counted.
class Counted {
public:
  Counted() = default;
  Counted(double value) : value_(value) {}

  static OperationCount& count() {
    static thread_local OperationCount operations;
    return operations;
  }
  double value() const { return value_; }

  friend Counted operator+(Counted a, Counted b) { return ++count().additions, a.value_ + b.value_; }
  friend Counted operator-(Counted a, Counted b) { return ++count().additions, a.value_ - b.value_; }
  friend Counted operator*(Counted a, Counted b) { return ++count().multiplications, a.value_ * b.value_; }
  friend Counted operator/(Counted a, Counted b) { return ++count().divisions, a.value_ / b.value_; }
  friend Counted sqrt(Counted a) { return ++count().roots, std::sqrt(a.value_); }
  friend Counted operator-(Counted a) { return -a.value_; }
  Counted& operator+=(Counted b) { return *this = *this + b; }
  Counted& operator-=(Counted b) { return *this = *this - b; }
  friend bool operator<(Counted a, Counted b) { return ++count().comparisons, a.value_ < b.value_; }
  friend bool operator>(Counted a, Counted b) { return ++count().comparisons, a.value_ > b.value_; }
  friend bool operator<=(Counted a, Counted b) { return ++count().comparisons, a.value_ <= b.value_; }
  friend bool operator>=(Counted a, Counted b) { return ++count().comparisons, a.value_ >= b.value_; }
  friend bool operator!=(Counted a, Counted b) { return ++count().comparisons, a.value_ != b.value_; }

private:
  double value_ = 0;
};

/// Counts what `work` does to numbers of type Counted.
template <class Work>
OperationCount operations_of(const Work& work) {
  Counted::count() = {};
  work();
  return Counted::count();
}

/// Of one intact, slightly loaded bond of the Dempack law with all features: motion of its ends,
/// law, and the sums of force and torque at both ends.
OperationCount operations_per_bond();

/// The same in single precision, of floats: what is done to integers is not counted.
OperationCount single_operations_per_bond();

}  // namespace breccia
