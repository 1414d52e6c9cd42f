// The loop over bonds in batches of a register: motion of the ends, law, forces. The same for every
// way of storing a bond: a `Bonds` has
//   load<Column>(b), store<Column>(b, values)   a quantity of bonds [b, b + width)
//   lo(k), hi(k)                                rows of the ends of bond k
//   size()                                      bonds stored
// Included by files that are compiled per instruction set only.
#pragma once
#include <algorithm>

#include "kernels/loops/batch_history.hpp"
#include "kernels/loops/batch_laws.hpp"
#include "kernels/loops/bond_pass.hpp"
#include "kernels/loops/scatter_block.hpp"
#include "kernels/math/lane_rows.hpp"

namespace breccia::BRECCIA_ISA {
namespace {

inline constexpr std::size_t ahead = 32;  // bonds, some 400 ns
inline constexpr std::size_t stride = sizeof(BondLoad) / sizeof(Vec3);
static_assert(bond_batch % width == 0 && ForceBuffer::capacity % bond_batch == 0);

/// Rows of the particles, all as far apart: a row is found once for the three.
struct ParticleRows {
  const Vec3 *position, *velocity, *spin;
  std::size_t stride;

  explicit ParticleRows(const BondPassIn& in)
      : position(in.position.data()),
        velocity(in.velocity.data()),
        spin(in.spin.data()),
        stride(in.position.stride()) {}
};

/// Rows are subtracted before they are turned into columns: four turns instead of six.
template <Features features, class Bonds>
[[gnu::always_inline]] inline Ends<Lanes> ends_of_batch(const ParticleRows& p, const Bonds& bonds,
                                                        std::size_t b) {
  const auto lo = [&](const Vec3* rows, std::size_t k) -> const Four& {
    return four(rows[bonds.lo(b + k) * p.stride]);
  };
  const auto hi = [&](const Vec3* rows, std::size_t k) -> const Four& {
    return four(rows[bonds.hi(b + k) * p.stride]);
  };
  Ends<Lanes> ends;
  ends.branch = columns_of([&](std::size_t k) { return hi(p.position, k) - lo(p.position, k); });
  ends.velocity = columns_of([&](std::size_t k) { return hi(p.velocity, k) - lo(p.velocity, k); });
  if constexpr (features.rotation) {
    ends.spin_sum = columns_of([&](std::size_t k) { return lo(p.spin, k) + hi(p.spin, k); });
    ends.spin_difference = columns_of([&](std::size_t k) { return lo(p.spin, k) - hi(p.spin, k); });
  }
  return ends;
}

/// Asks for the rows of the far ends of a later batch: the stream of bonds pushes particles out of
/// the near caches, and the processor cannot guess which come next. Bonds are sorted by their lower
/// row, so the other end has just been used.
template <Features features, class Bonds>
[[gnu::always_inline]] inline void prefetch_ends(const ParticleRows& p, const Bonds& bonds, const Scatter& to,
                                                 std::size_t b) {
  for (std::size_t k = b; k < b + width; ++k) {
    const std::size_t row = std::max(bonds.lo(k), bonds.hi(k)) * p.stride;
    __builtin_prefetch(&p.position[row]);
    __builtin_prefetch(&p.velocity[row]);
    if constexpr (features.rotation) __builtin_prefetch(&p.spin[row]);
  }
  if (to.mode != ScatterMode::own) return;
  for (std::size_t k = b; k < b + width; ++k) {
    const Index row = std::max(to.to_lo[k], to.to_hi[k]);
    __builtin_prefetch(&to.force[row], 1);
    if constexpr (features.rotation) __builtin_prefetch(&to.torque[row], 1);
  }
}

/// Where nobody else adds to the same rows, the forces of a batch are added while the next one is
/// worked out, a quarter of them at each of four places: a processor looks some 300 instructions
/// ahead, a batch has 600, and additions behind all of the arithmetic would wait for it.
template <Features features>
struct Waiting {
  const Scatter& to;
  const ForceBuffer& block;
  const Strided<Vec3> moments;
  const bool adds;
  std::size_t bond = 0, place = 0;
  bool any = false;

  Waiting(const Scatter& scatter, const ForceBuffer& loads)
      : to(scatter),
        block(loads),
        moments(rows_of_moments(scatter)),
        adds(scatter.mode == ScatterMode::own && (!features.rotation || !scatter.torque.empty())) {}

  template <std::size_t quarter>
  [[gnu::always_inline]] inline void add() const {
    if (!any) return;
    for (std::size_t k = quarter * width / 4; k < (quarter + 1) * width / 4; ++k)
      add_bond<features.rotation>(to, moments, block.load[place + k], bond + k, PlainAdd{});
  }
  [[gnu::always_inline]] inline void follow(std::size_t b, std::size_t k) { bond = b, place = k, any = adds; }
  void finish() const { add<0>(), add<1>(), add<2>(), add<3>(); }
};

/// Bonds [first, last). To be flattened by the caller: with several laws in one file the compiler
/// stops inlining a law into its loop by itself, and wide registers then travel through memory (19
/// ns a bond instead of 13).
/// @tparam ledger  losses are summed block by block, `losses[b/64]`; ranges then begin at whole
///                 blocks, so that no sum depends on how the bonds are shared out
template <Features features, bool ledger, class Law, class Bonds>
[[gnu::always_inline]] inline void bond_loop(const Law& law, double dt, const ParticleRows& p,
                                             const Bonds& bonds, std::size_t first, std::size_t last,
                                             const Scatter& to, BreakNotes* notes,
                                             std::span<BondLosses<double>> losses = {}) {
  ForceBuffer block;
  Waiting<features> waiting(to, block);
  while (first < last) {
    const std::size_t count = last - first < ForceBuffer::capacity ? last - first : ForceBuffer::capacity;
    [[maybe_unused]] BondLosses<Lanes> loss;
    for (std::size_t k = 0; k < count; k += width) {
      const std::size_t b = first + k;
      if (b + ahead < bonds.size()) prefetch_ends<features>(p, bonds, to, b + ahead);
      Lanes arm_offset(0.0);
      if constexpr (features.rotation) arm_offset = bonds.template load<Column::arm_offset>(b);
      const Ends<Lanes> ends = ends_of_batch<features>(p, bonds, b);
      waiting.template add<0>();
      const Pair<Lanes> pair = relative_motion<features.rotation>(ends, arm_offset, dt);
      waiting.template add<1>();
      BondConstants<Lanes> bond{bonds.template load<Column::rest_length>(b),
                                bonds.template load<Column::area>(b),
                                bonds.template load<Column::strength_area>(b),
                                bonds.template load<Column::stiffness>(b), Lanes(0.0)};
      if constexpr (features.contact_damping) bond.damping = bonds.template load<Column::damping>(b);
      const BondHistory<Lanes> before = history_of<features, Lanes>(bonds, b);
      BondHistory<Lanes> h = before;
      const BondStrain<Lanes> strain = strain_of<features.plasticity>(bond, pair, before.plastic_stretch);
      const Vec<Lanes> rotated = rotate_with_pair<features.rotation>(before.shear, pair);
      h.shear = rotated + shear_stiffness_of(law, b, bond.stiffness) * strain.slip;
      const BondAction<Lanes> action = act_on_batch<features>(law, b, bond, strain, rotated, h);
      waiting.template add<2>();
      const Vec<Lanes> force = force_on_lo(action, pair);
      keep_history<features>(bonds, h, before, b, notes);
      if constexpr (ledger)
        keep_losses<features>(law, bond, strain, elongation(ends, pair, dt), before, h, action, bonds, b,
                              loss);
      waiting.template add<3>();
      store_rows(force, &block.load[k].force, stride);
      if constexpr (features.rotation)
        store_rows(pair.distance * cross(pair.normal, force), &block.load[k].moment, stride);
      waiting.follow(b, k);
    }
    if constexpr (ledger) add_lanes(loss, 1.0, losses[first / ForceBuffer::capacity]);
    if (!waiting.adds) scatter_block(to, block, first, count);
    first += count;
  }
  waiting.finish();
}

}  // namespace
}  // namespace breccia::BRECCIA_ISA
