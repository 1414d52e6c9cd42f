// Which range of bonds (or contacts) may add to which particle, worked out once when the rows are
// sorted. A particle touched from one range only is interior and gets plain adds; every other is
// shared: docs/model.md, "Order of sums and times in a step".
#pragma once
#include <span>
#include <vector>

#include "core/base/scene_options.hpp"
#include "core/ranks/partition.hpp"
#include "core/tables/particle_table.hpp"
#include "kernels/loops/scatter.hpp"

namespace breccia {

struct ScatterPlan {
  ScatterKind kind = ScatterKind::private_sums;
  int ranges = 1;
  std::size_t rows = 0;        ///< bonds, padding included
  std::size_t batch = 1;       ///< ranges begin at multiples of this
  Column<Index> to_lo, to_hi;  ///< empty where they equal the rows of the ends
  /// private sums: shared particle k adds slots[first_slot[k] ... first_slot[k + 1]), in the order
  /// of ranges
  std::vector<Index> shared, first_slot, slots;
  std::size_t slot_count = 0;
  /// gather: particle p sums entries[first_entry[p] ...): bond row << 1 | particle is hi, in the
  /// order of bonds' ids
  Column<Index> first_entry, entries;
  Column<double> entry_share;  ///< of the bond's moment that the particle gets; empty without torques
  Column<BondLoad> bond_load;
  Column<BondLoad> couples;  ///< of a second pass, over torques: equal and opposite; empty: none

  std::size_t first(int range) const;
};

/// @param gid_lo, gid_hi  ids of the ends: they order the sums of `gather`
/// @param arm_offset      lo gets 1/2 + this of a bond's moment, hi the rest; empty where nothing
///         spins
ScatterPlan plan_scatter(ScatterKind kind, int ranges, std::size_t batch, std::span<const Index> row_lo,
                         std::span<const Index> row_hi, std::span<const Gid> gid_lo,
                         std::span<const Gid> gid_hi, std::span<const double> arm_offset,
                         std::size_t particles);

/// The view that a pass writes to; valid until the tables change.
Scatter scatter_view(ScatterPlan& plan, std::span<const Index> row_lo, std::span<const Index> row_hi,
                     std::span<const double> arm_offset, ParticleTable& particles);

/// The same for a pass over couples, behind that over forces and before they are collected.
Scatter couple_view(ScatterPlan& plan, std::span<const Index> row_lo, std::span<const Index> row_hi,
                    ParticleTable& particles);

/// After the pass: adds the ranges' own sums, or the columns of forces, to the particles.
/// @param own  rows that get their sums; of others forces mean nothing
void collect(ScatterPlan& plan, ParticleTable& particles, Rows own, int threads);

}  // namespace breccia
