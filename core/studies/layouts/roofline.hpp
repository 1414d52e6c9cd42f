// What the machine lets a pass take at least: as long as its bytes take to move, and as long as its
// operations take. Williams, Waterman, Patterson, "Roofline: an insightful visual performance model
// for multicore architectures", Commun. ACM 52 (2009) 65-76.
#pragma once
#include <cstddef>

#include "kernels/math/instruction_set.hpp"

namespace breccia {

struct MachinePeak {
  double bandwidth = 0;   ///< B/s, of a stream over a set of the same size
  double operations = 0;  ///< 1/s, multiplications and additions of doubles
};

/// Both measured now, best of `repeat` tries of about `seconds` each.
/// @param set_bytes  what the stream runs over, shared by all threads
MachinePeak measure_peak(InstructionSet set, int threads, double set_bytes, int repeat, double seconds);

struct PassLimit {
  double memory = 0, arithmetic = 0;  ///< s per bond
  double time() const { return memory > arithmetic ? memory : arithmetic; }
};

/// @param bytes, operations  per bond
inline PassLimit limit_of(const MachinePeak& peak, double bytes, double operations) {
  return {bytes / peak.bandwidth, operations / peak.operations};
}

}  // namespace breccia
