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

[[gnu::always_inline]] inline auto damaged_lanes(const BondHistory<Lanes>& h) {
  return h.damage_normal > 0.0 || h.damage_shear > 0.0;
}

template <Features features>
[[gnu::always_inline]] inline bool is_damaged(const BondHistory<Lanes>& h) {
  if constexpr (features.breakage)
    return any(damaged_lanes(h));
  else
    return false;
}

/// What the bonds of a batch end the step with, under one law.
template <Features features, class Law>
[[gnu::always_inline]] inline BondAction<Lanes> act_on_batch(const Law& law, std::size_t,
                                                             const BondConstants<Lanes>& bond,
                                                             const Pair<Lanes>& pair, BondHistory<Lanes>& h) {
  return bond_action<features>(law, bond, pair, h);
}

/// Forces that a batch ended the step before with; of damaged bonds they do not follow from the
/// state, and were kept.
template <Features features, class Law, class Bonds>
[[gnu::always_inline]] inline LastForces<Lanes> last_forces(const Law& law, const BondConstants<Lanes>& bond,
                                                            const Pair<Lanes>& pair, const Lanes& stretch,
                                                            const BondHistory<Lanes>& before,
                                                            const Bonds& bonds, std::size_t b) {
  Lanes viscous(0.0);
  if constexpr (features.contact_damping) viscous = bonds.template load<BondColumn::viscous_force>(b);
  LastForces<Lanes> last = forces_before<features>(law, bond, pair, stretch, before, viscous);
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
template <Features features, class Law, class Bonds>
[[gnu::always_inline]] inline BondLosses<Lanes> losses_of_batch(
    const Law& law, const BondConstants<Lanes>& bond, const Pair<Lanes>& pair, const Lanes& stretch,
    const BondHistory<Lanes>& before, const BondHistory<Lanes>& h, const BondAction<Lanes>& action,
    const Bonds& bonds, std::size_t b, LastForces<Lanes>& last) {
  last = last_forces<features>(law, bond, pair, stretch, before, bonds, b);
  return losses_of_step<features>(law, bond, pair, stretch, before, h, action, last);
}

template <class Law>
struct LawTable {
  std::span<const BondLaw> laws;
  std::span<const LawIndex> of_bond;

  /// Calls act(law, its lanes) for each law of a batch.
  template <class Act>
  [[gnu::always_inline]] void for_each(std::size_t b, const Act& act) const {
    const Lanes which([&](auto k) { return static_cast<double>(of_bond[b + k]); });
    for (std::size_t l = 0; l < laws.size(); ++l) {
      const auto lanes = which == Lanes(static_cast<double>(l));
      if (any(lanes)) act(*std::get_if<Law>(&laws[l]), lanes);
    }
  }
};

template <class Mask>
inline void take(const Mask& lanes, const BondHistory<Lanes>& from, BondHistory<Lanes>& to) {
  to.shear = select(lanes, from.shear, to.shear);
  to.plastic_stretch = select(lanes, from.plastic_stretch, to.plastic_stretch);
  to.damage_normal = select(lanes, from.damage_normal, to.damage_normal);
  to.damage_shear = select(lanes, from.damage_shear, to.damage_shear);
}

template <class Mask>
inline void take(const Mask& lanes, const BondAction<Lanes>& from, BondAction<Lanes>& to) {
  to.spring = select(lanes, from.spring, to.spring);
  to.along = select(lanes, from.along, to.along);
  to.shear_factor = select(lanes, from.shear_factor, to.shear_factor);
  to.shear = select(lanes, from.shear, to.shear);
  to.rotated = select(lanes, from.rotated, to.rotated);
  if (!from.yields) return;
  to.yields = true;
  to.yielded = select(lanes, from.yielded, to.yielded);
}

template <class Mask>
inline void take(const Mask& lanes, const BondLosses<Lanes>& from, BondLosses<Lanes>& to) {
  to.plastic = select(lanes, from.plastic, to.plastic);
  to.viscous = select(lanes, from.viscous, to.viscous);
  to.damage = select(lanes, from.damage, to.damage);
  to.friction = select(lanes, from.friction, to.friction);
  to.failure = select(lanes, from.failure, to.failure);
}

template <class Mask>
inline void take(const Mask& lanes, const LastForces<Lanes>& from, LastForces<Lanes>& to) {
  to.spring = select(lanes, from.spring, to.spring);
  to.viscous = select(lanes, from.viscous, to.viscous);
  to.shear_factor = select(lanes, from.shear_factor, to.shear_factor);
}

template <Features features, class Law>
inline BondAction<Lanes> act_on_batch(const LawTable<Law>& table, std::size_t b,
                                      const BondConstants<Lanes>& bond, const Pair<Lanes>& pair,
                                      BondHistory<Lanes>& h) {
  const BondHistory<Lanes> before = h;
  BondAction<Lanes> action{};
  table.for_each(b, [&](const Law& law, const auto& lanes) {
    BondHistory<Lanes> after = before;
    take(lanes, bond_action<features>(law, bond, pair, after), action);
    take(lanes, after, h);
  });
  return action;
}

template <Features features, class Law, class Bonds>
inline BondLosses<Lanes> losses_of_batch(const LawTable<Law>& table, const BondConstants<Lanes>& bond,
                                         const Pair<Lanes>& pair, const Lanes& stretch,
                                         const BondHistory<Lanes>& before, const BondHistory<Lanes>& h,
                                         const BondAction<Lanes>& action, const Bonds& bonds, std::size_t b,
                                         LastForces<Lanes>& last) {
  BondLosses<Lanes> loss{};
  last = {};
  table.for_each(b, [&](const Law& law, const auto& lanes) {
    LastForces<Lanes> end;
    take(lanes, losses_of_batch<features>(law, bond, pair, stretch, before, h, action, bonds, b, end), loss);
    take(lanes, end, last);
  });
  return loss;
}

}  // namespace
}  // namespace breccia::BRECCIA_ISA
