#include "kernels/scatter.hpp"

#include <atomic>

namespace breccia {
namespace {

void add(Vec3& sum, const Vec3& f) { sum += f; }

void add_atomic(Vec3& sum, const Vec3& f) {
  std::atomic_ref(sum.x).fetch_add(f.x, std::memory_order_relaxed);
  std::atomic_ref(sum.y).fetch_add(f.y, std::memory_order_relaxed);
  std::atomic_ref(sum.z).fetch_add(f.z, std::memory_order_relaxed);
}

Vec3 force_of(const ForceBlock& b, std::size_t k) { return {b.fx[k], b.fy[k], b.fz[k]}; }
Vec3 turn_of(const ForceBlock& b, std::size_t k) { return {b.tx[k], b.ty[k], b.tz[k]}; }

template <bool torques>
void scatter_own(const Scatter& to, const ForceBlock& block, std::size_t first, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) {
    const Index lo = to.to_lo[first + k], hi = to.to_hi[first + k];
    const Vec3 f = force_of(block, k);
    add(to.force[lo], f);
    add(to.force[hi], -f);
    if constexpr (torques) {
      const Vec3 turn = turn_of(block, k);
      add(to.torque[lo], to.radius[to.row_lo[first + k]] * turn);
      add(to.torque[hi], to.radius[to.row_hi[first + k]] * turn);
    }
  }
}

void scatter_atomic(const Scatter& to, const ForceBlock& block, std::size_t first, std::size_t count) {
  const auto add_to = [](std::span<Vec3> sums, Index row, const Vec3& f) {
    if (row & shared_row)
      add_atomic(sums[row & ~shared_row], f);
    else
      add(sums[row], f);
  };
  for (std::size_t k = 0; k < count; ++k) {
    const Index lo = to.to_lo[first + k], hi = to.to_hi[first + k];
    const Vec3 f = force_of(block, k);
    add_to(to.force, lo, f);
    add_to(to.force, hi, -f);
    if (!to.torque.empty()) {
      const Vec3 turn = turn_of(block, k);
      add_to(to.torque, lo, to.radius[to.row_lo[first + k]] * turn);
      add_to(to.torque, hi, to.radius[to.row_hi[first + k]] * turn);
    }
  }
}

void scatter_columns(const Scatter& to, const ForceBlock& block, std::size_t first, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) to.bond_force[first + k] = force_of(block, k);
  if (to.bond_turn.empty()) return;
  for (std::size_t k = 0; k < count; ++k) to.bond_turn[first + k] = turn_of(block, k);
}

}  // namespace

void scatter(const Scatter& to, const ForceBlock& block, std::size_t first, std::size_t count) {
  switch (to.mode) {
    case ScatterMode::own:
      to.torque.empty() ? scatter_own<false>(to, block, first, count)
                        : scatter_own<true>(to, block, first, count);
      break;
    case ScatterMode::atomic:
      scatter_atomic(to, block, first, count);
      break;
    case ScatterMode::columns:
      scatter_columns(to, block, first, count);
      break;
  }
}

}  // namespace breccia
