// What the processor can do at best, for one instruction set.
#pragma once
#include <cstddef>

#include "kernels/math/instruction_set.hpp"

namespace breccia {

/// Four columns of as many values; three are read, one is read and written: much as a pass over
/// bonds.
struct StreamColumns {
  const double *a, *b, *c;
  double* d;
};

struct MachineRates {
  /// Sweeps over values [first, last) of the columns, `sweeps` times.
  void (*stream)(const StreamColumns&, std::size_t first, std::size_t last, std::size_t sweeps);
  /// Multiplications and additions that do not wait for each other. @returns a number that depends
  /// on all
  double (*multiply_add)(std::size_t rounds);
  double operations_per_round;  ///< of `multiply_add`
};

const MachineRates& machine_rates(InstructionSet set);

}  // namespace breccia
