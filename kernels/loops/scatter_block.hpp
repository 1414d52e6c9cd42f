// How a block of forces is added, row by row. Included by each file that adds: in the loop over
// bonds it is compiled for the loop's own registers. Everything here has internal linkage, so that
// no function built for wide registers can be linked into code that runs without them.
#pragma once
#include <atomic>

#include "kernels/loops/scatter.hpp"
#include "kernels/math/four.hpp"

namespace breccia {
namespace {

inline void add_atomic(double& sum, double f) {
  std::atomic_ref(sum).fetch_add(f, std::memory_order_relaxed);
}

struct PlainAdd {
  [[gnu::always_inline]] void operator()(const Strided<Vec3>& sums, Index row, const Four& f) const {
    four(sums[row]) += f;
  }
};

struct AtomicAdd {
  void operator()(const Strided<Vec3>& sums, Index row, const Four& f) const {
    Vec3& sum = sums[row & ~shared_row];
    if (!(row & shared_row)) {
      four(sum) += f;
      return;
    }
    add_atomic(sum.x, f[0]);
    add_atomic(sum.y, f[1]);
    add_atomic(sum.z, f[2]);
  }
};

/// The rows of moments, as far apart as those of forces; none where nothing spins.
inline Strided<Vec3> rows_of_moments(const Scatter& to) {
  return {to.torque.data(), to.torque.size(), to.force.stride()};
}

/// Adds the load of one bond to both its ends.
template <bool torques, class Add>
[[gnu::always_inline]] inline void add_bond(const Scatter& to, const Strided<Vec3>& moments,
                                            const BondLoad& load, std::size_t bond, const Add& add) {
  const Index lo = to.to_lo[bond], hi = to.to_hi[bond];
  const Four &force = four(load.force), &moment = four(load.moment);
  add(to.force, lo, force);
  add(to.force, hi, -force);  // (P3) (P18)
  if constexpr (torques) {
    const double offset = to.arm_offset[bond];
    add(moments, lo, (0.5 + offset) * moment);  // (P4) (B3)
    add(moments, hi, (0.5 - offset) * moment);
  }
}

template <bool torques, class Add>
[[gnu::always_inline]] inline void add_block(const Scatter& to, const ForceBuffer& block, std::size_t first,
                                             std::size_t count, const Add& add) {
  const Strided<Vec3> moments = rows_of_moments(to);
  for (std::size_t k = 0; k < count; ++k) add_bond<torques>(to, moments, block.load[k], first + k, add);
}

inline void keep_block(const Scatter& to, const ForceBuffer& block, std::size_t first, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) {
    four(to.bond_load[first + k].force) = four(block.load[k].force);
    four(to.bond_load[first + k].moment) = four(block.load[k].moment);
  }
}

inline void scatter_block(const Scatter& to, const ForceBuffer& block, std::size_t first, std::size_t count) {
  const bool torques = !to.torque.empty();
  if (to.mode == ScatterMode::column)
    keep_block(to, block, first, count);
  else if (to.mode == ScatterMode::own)
    torques ? add_block<true>(to, block, first, count, PlainAdd{})
            : add_block<false>(to, block, first, count, PlainAdd{});
  else
    torques ? add_block<true>(to, block, first, count, AtomicAdd{})
            : add_block<false>(to, block, first, count, AtomicAdd{});
}

}  // namespace
}  // namespace breccia
