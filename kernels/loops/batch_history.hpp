// What a batch of bonds remembers of a step, and what the ledger books of it. Included by files
// that are compiled per instruction set only.
#pragma once
#include "kernels/loops/batch_laws.hpp"
#include "kernels/loops/bond_column.hpp"
#include "kernels/loops/bond_ledger.hpp"
#include "kernels/loops/bond_pass.hpp"

namespace breccia::BRECCIA_ISA {
namespace {

using Column = BondColumn;

/// Which lanes of a batch broke in this step goes into the notes; rare, so out of the loop's way.
template <Features features, class R, class Bonds>
[[gnu::noinline]] void note_breaks(const Bonds& bonds, const BondHistory<R> now, const BondHistory<R> before,
                                   std::size_t b, BreakNotes& notes) {
  for (std::size_t k = 0; k < R::size(); ++k) {
    const bool was = before.damage_normal[k] >= 1.0 || before.damage_shear[k] >= 1.0;
    const bool is = now.damage_normal[k] >= 1.0 || now.damage_shear[k] >= 1.0;
    if (was || !is) continue;
    if (notes.count < notes.room.size())
      notes.room[notes.count] =
          bonds.in_si({static_cast<Index>(b + k),
                       {before.shear.x[k], before.shear.y[k], before.shear.z[k]},
                       features.plasticity ? static_cast<double>(before.plastic_stretch[k]) : 0.0,
                       before.damage_normal[k],
                       before.damage_shear[k]});
    ++notes.count;
  }
}

template <Features features, class R, class Bonds>
[[gnu::always_inline]] inline BondHistory<R> history_of(const Bonds& bonds, std::size_t b) {
  BondHistory<R> h;
  h.shear = {bonds.template load<Column::shear_x>(b), bonds.template load<Column::shear_y>(b),
             bonds.template load<Column::shear_z>(b)};
  if constexpr (features.plasticity) h.plastic_stretch = bonds.template load<Column::plastic_stretch>(b);
  if constexpr (features.breakage) {
    h.damage_normal = bonds.template load<Column::damage_normal>(b);
    h.damage_shear = bonds.template load<Column::damage_shear>(b);
  }
  return h;
}

/// Most batches neither yield nor break in a step: what stays is not written.
template <Features features, class R, class Bonds>
[[gnu::always_inline]] inline void keep_history(const Bonds& bonds, const BondHistory<R>& h,
                                                const BondHistory<R>& before, std::size_t b,
                                                BreakNotes* notes) {
  bonds.template store<Column::shear_x>(b, h.shear.x);
  bonds.template store<Column::shear_y>(b, h.shear.y);
  bonds.template store<Column::shear_z>(b, h.shear.z);
  if constexpr (features.plasticity)
    if (any(h.plastic_stretch != before.plastic_stretch))
      bonds.template store<Column::plastic_stretch>(b, h.plastic_stretch);
  if constexpr (features.breakage)
    if (any(h.damage_normal != before.damage_normal || h.damage_shear != before.damage_shear)) {
      bonds.template store<Column::damage_normal>(b, h.damage_normal);
      bonds.template store<Column::damage_shear>(b, h.damage_shear);
      if (notes) note_breaks<features>(bonds, h, before, b, *notes);
    }
}

/// Whether springs store all that a batch takes up in this step: where nothing is damaged and
/// nothing yields, (B53) is zero but for round-off, whatever the pair's turn.
template <Features features, class R>
[[gnu::always_inline]] inline bool loses_nothing_but_damping(const BondHistory<R>& before,
                                                             const BondHistory<R>& h) {
  if (features.unloading || is_damaged<features>(h)) return false;
  if constexpr (features.plasticity) return !any(h.plastic_stretch != before.plastic_stretch);
  return true;
}

/// The dashpots' part alone: work of the mean of the forces before and after.
/// @param viscous  N, tension positive
template <class R, class Bonds>
[[gnu::always_inline]] inline void keep_viscous_loss(const R& viscous, const R& stretch, const Bonds& bonds,
                                                     std::size_t b, BondLosses<R>& sum) {
  sum.viscous += R(0.5) * (bonds.template load<Column::viscous_force>(b) + viscous) * stretch;  // (B55)
  bonds.template store<Column::viscous_force>(b, viscous);
}

/// Losses of a batch, added to those of its block; forces that do not follow from the state are
/// kept for the next step.
/// @param stretch  m, elongation of the step
template <Features features, class Law, class R, class Bonds>
[[gnu::always_inline]] inline void keep_losses(const Law& law, const BondConstants<R>& bond,
                                               const BondStrain<R>& strain, const R& stretch,
                                               const BondHistory<R>& before, const BondHistory<R>& h,
                                               const BondAction<R>& action, const Bonds& bonds, std::size_t b,
                                               BondLosses<R>& sum) {
  if (loses_nothing_but_damping<features>(before, h)) {
    if constexpr (features.contact_damping)
      keep_viscous_loss(R(action.along - action.spring), stretch, bonds, b, sum);
    return;
  }
  LastForces<R> last;
  const BondLosses<R> loss =
      losses_of_batch<features>(law, bond, strain, stretch, before, h, action, bonds, b, last);
  if constexpr (features.contact_damping) bonds.template store<Column::viscous_force>(b, last.viscous);
  if (is_damaged<features>(h)) {
    bonds.template store<Column::spring_force>(b, last.spring);
    bonds.template store<Column::shear_factor>(b, last.shear_factor);
  }
  sum.plastic += loss.plastic;
  sum.viscous += loss.viscous;
  sum.damage += loss.damage;
  sum.friction += loss.friction;
  sum.failure += loss.failure;
}

/// @param unit  J
template <class R>
[[gnu::always_inline]] inline void add_lanes(const BondLosses<R>& sum, double unit, BondLosses<double>& to) {
  to.plastic += unit * sum_of_lanes(sum.plastic);
  to.viscous += unit * sum_of_lanes(sum.viscous);
  to.damage += unit * sum_of_lanes(sum.damage);
  to.friction += unit * sum_of_lanes(sum.friction);
  to.failure += unit * sum_of_lanes(sum.failure);
}

}  // namespace
}  // namespace breccia::BRECCIA_ISA
