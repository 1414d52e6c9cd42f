// Adding the force of each bond to both its ends, when several threads work on neighbouring bonds.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "kernels/math/strided.hpp"
#include "kernels/math/vec3.hpp"

namespace breccia {

using Index = std::uint32_t;

/// What a bond does to its ends; one line of the cache.
struct alignas(64) BondLoad {
  Vec3 force;   ///< N, on lo; on hi the opposite
  Vec3 moment;  ///< N m, branch x force: each end gets its share of it
};

/// Of up to 64 consecutive bonds, as the law leaves them.
struct ForceBuffer {
  static constexpr std::size_t capacity = 64;
  BondLoad load[capacity];
};

/// Where a range of bonds may add its forces.
/// own:     plain adds to rows `to_lo`, `to_hi` that no other range touches (particles, or the
///          range's own sums) (B92)
/// atomic:  as own, but a row with the top bit set is a particle that other ranges touch too: added
///          atomically (B93)
/// column:  one load per bond, summed later in a fixed order (B94)
enum class ScatterMode : unsigned char { own, atomic, column };

inline constexpr Index shared_row = 0x80000000u;

struct Scatter {
  ScatterMode mode = ScatterMode::own;
  std::span<const Index> to_lo, to_hi;  ///< rows to add to
  std::span<const double> arm_offset;   ///< per bond: lo gets 1/2 + this of the moment, hi the rest
  Strided<Vec3> force, torque;    ///< N, N m, as far apart as each other; torque is empty where nothing spins
  std::span<BondLoad> bond_load;  ///< column: per bond
};

/// Adds `count` loads of bonds [first, first + count).
void scatter(const Scatter& to, const ForceBuffer& block, std::size_t first, std::size_t count);

}  // namespace breccia
