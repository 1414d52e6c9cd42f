// What a batch of bonds does under its law, or under the laws of several materials: then it is
// worked out once under each law that it has, and every lane takes what its own law made of it.
// Bonds of neighbouring rows mostly share their material, so that most batches have one law.
// Included by files that are compiled per instruction set only. docs/model.md, "Several materials".
#pragma once
#include <span>

#include "kernels/laws/bond_laws.hpp"
#include "kernels/loops/bond_column.hpp"
#include "kernels/loops/bond_ledger.hpp"
#include "kernels/math/lane_rows.hpp"

namespace breccia::BRECCIA_ISA {
namespace {

template <class R>
[[gnu::always_inline]] inline auto damaged_lanes(const BondHistory<R>& h) {
  return h.damage_normal > 0.0 || h.damage_shear > 0.0;
}

template <Features features, class R>
[[gnu::always_inline]] inline bool is_damaged(const BondHistory<R>& h) {
  if constexpr (features.breakage)
    return any(damaged_lanes(h));
  else
    return false;
}

/// k_s, N/m.
template <class Law, class R>
[[gnu::always_inline]] inline R shear_stiffness_of(const Law& law, std::size_t, const R& stiffness) {
  return R(law.shear_ratio) * stiffness;
}

/// What the bonds of a batch end the step with, under one law.
/// @param rotated  the history of shear, turned with the pairs
/// @param h        h.shear: the same with k_s du added
template <Features features, class Law, class R>
[[gnu::always_inline]] inline BondAction<R> act_on_batch(const Law& law, std::size_t,
                                                         const BondConstants<R>& bond,
                                                         const BondStrain<R>& strain, const Vec<R>& rotated,
                                                         BondHistory<R>& h) {
  return strained<features>(law, bond, strain, rotated, h);
}

/// Forces that a batch ended the step before with; of damaged bonds they do not follow from the
/// state, and were kept.
template <Features features, class Law, class R, class Bonds>
[[gnu::always_inline]] inline LastForces<R> last_forces(const Law& law, const BondConstants<R>& bond,
                                                        const BondStrain<R>& strain, const R& stretch,
                                                        const BondHistory<R>& before, const Bonds& bonds,
                                                        std::size_t b) {
  R viscous(0.0);
  if constexpr (features.contact_damping) viscous = bonds.template load<BondColumn::viscous_force>(b);
  LastForces<R> last = forces_before<features>(law, bond, strain, stretch, before, viscous);
  if (is_damaged<features>(before)) {
    // bond by bond: which others share a register changes with the processor and the number of
    // ranks
    const auto damaged = damaged_lanes(before);
    last.spring = select(damaged, bonds.template load<BondColumn::spring_force>(b), last.spring);
    last.shear_factor = select(damaged, bonds.template load<BondColumn::shear_factor>(b), last.shear_factor);
  }
  return last;
}

/// Losses of a batch under one law; `last` becomes what it ends this step with.
template <Features features, class Law, class R, class Bonds>
[[gnu::always_inline]] inline BondLosses<R> losses_of_batch(const Law& law, const BondConstants<R>& bond,
                                                            const BondStrain<R>& strain, const R& stretch,
                                                            const BondHistory<R>& before,
                                                            const BondHistory<R>& h,
                                                            const BondAction<R>& action, const Bonds& bonds,
                                                            std::size_t b, LastForces<R>& last) {
  last = last_forces<features>(law, bond, strain, stretch, before, bonds, b);
  return losses_of_step<features>(law, bond, strain, stretch, before, h, action, last);
}

template <class Law>
struct LawTable {
  std::span<const BondLaw> laws;
  std::span<const LawIndex> of_bond;

  /// Calls act(law, its lanes) for each law of a batch.
  template <class R, class Act>
  [[gnu::always_inline]] void for_each(std::size_t b, const Act& act) const {
    const R which([&](auto k) { return static_cast<typename R::value_type>(of_bond[b + k]); });
    for (std::size_t l = 0; l < laws.size(); ++l) {
      const auto lanes = which == R(static_cast<double>(l));
      if (any(lanes)) act(*std::get_if<Law>(&laws[l]), lanes);
    }
  }
};

template <class Mask, class R>
inline void take(const Mask& lanes, const BondHistory<R>& from, BondHistory<R>& to) {
  to.shear = select(lanes, from.shear, to.shear);
  to.plastic_stretch = select(lanes, from.plastic_stretch, to.plastic_stretch);
  to.damage_normal = select(lanes, from.damage_normal, to.damage_normal);
  to.damage_shear = select(lanes, from.damage_shear, to.damage_shear);
}

template <class Mask, class R>
inline void take(const Mask& lanes, const BondAction<R>& from, BondAction<R>& to) {
  to.spring = select(lanes, from.spring, to.spring);
  to.along = select(lanes, from.along, to.along);
  to.shear_factor = select(lanes, from.shear_factor, to.shear_factor);
  to.shear = select(lanes, from.shear, to.shear);
  to.rotated = select(lanes, from.rotated, to.rotated);
  if (!from.yields) return;
  to.yields = true;
  to.yielded = select(lanes, from.yielded, to.yielded);
}

template <class Mask, class R>
inline void take(const Mask& lanes, const BondLosses<R>& from, BondLosses<R>& to) {
  to.plastic = select(lanes, from.plastic, to.plastic);
  to.viscous = select(lanes, from.viscous, to.viscous);
  to.damage = select(lanes, from.damage, to.damage);
  to.friction = select(lanes, from.friction, to.friction);
  to.failure = select(lanes, from.failure, to.failure);
}

template <class Mask, class R>
inline void take(const Mask& lanes, const LastForces<R>& from, LastForces<R>& to) {
  to.spring = select(lanes, from.spring, to.spring);
  to.viscous = select(lanes, from.viscous, to.viscous);
  to.shear_factor = select(lanes, from.shear_factor, to.shear_factor);
}

template <class Law, class R>
inline R shear_stiffness_of(const LawTable<Law>& table, std::size_t b, const R& stiffness) {
  R k_s(0.0);
  table.template for_each<R>(b, [&](const Law& law, const auto& lanes) {
    k_s = select(lanes, R(law.shear_ratio) * stiffness, k_s);
  });
  return k_s;
}

template <Features features, class Law, class R>
inline BondAction<R> act_on_batch(const LawTable<Law>& table, std::size_t b, const BondConstants<R>& bond,
                                  const BondStrain<R>& strain, const Vec<R>& rotated, BondHistory<R>& h) {
  const BondHistory<R> before = h;
  BondAction<R> action{};
  table.template for_each<R>(b, [&](const Law& law, const auto& lanes) {
    BondHistory<R> after = before;
    take(lanes, strained<features>(law, bond, strain, rotated, after), action);
    take(lanes, after, h);
  });
  return action;
}

template <Features features, class Law, class R, class Bonds>
inline BondLosses<R> losses_of_batch(const LawTable<Law>& table, const BondConstants<R>& bond,
                                     const BondStrain<R>& strain, const R& stretch,
                                     const BondHistory<R>& before, const BondHistory<R>& h,
                                     const BondAction<R>& action, const Bonds& bonds, std::size_t b,
                                     LastForces<R>& last) {
  BondLosses<R> loss{};
  last = {};
  table.template for_each<R>(b, [&](const Law& law, const auto& lanes) {
    LastForces<R> end;
    take(lanes, losses_of_batch<features>(law, bond, strain, stretch, before, h, action, bonds, b, end),
         loss);
    take(lanes, end, last);
  });
  return loss;
}

}  // namespace
}  // namespace breccia::BRECCIA_ISA
