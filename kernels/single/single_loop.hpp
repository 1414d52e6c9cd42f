// The loop over bonds in single precision: the law in registers of floats, between integers that
// the ends' motion is read from and the forces are added to. docs/model.md, "Single precision".
// Included by files that are compiled per instruction set only.
#pragma once
#include <algorithm>
#include <atomic>

#include "kernels/loops/batch_history.hpp"
#include "kernels/math/record_rows.hpp"
#include "kernels/single/pair_motion.hpp"
#include "kernels/single/single.hpp"

namespace breccia::BRECCIA_ISA {
namespace {

/// Of a column of a block, the values of bonds [b, b + float_width).
[[gnu::always_inline]] inline FloatLanes lanes_at(const float (&column)[bond_block], std::size_t b) {
  return FloatLanes::Register(column + b % bond_block, std::experimental::vector_aligned);
}

/// Bonds as blocks of sixteen, as the shared parts of the loops take them.
struct BlockBonds {
  const SinglePassIn& in;

  template <Column column>
  [[gnu::always_inline]] FloatLanes load(std::size_t b) const {
    if constexpr (column == Column::strength_area)
      return in.own_strength_area ? lanes_at(in.rare[b / bond_block].strength_area, b)
                                  : load<Column::area>(b);
    else
      return lanes_at(values<column>(b), b);
  }
  template <Column column>
  [[gnu::always_inline]] void store(std::size_t b, const FloatLanes& lanes) const {
    if constexpr (column == Column::plastic_stretch)
      to(in.bonds[b / bond_block].plastic, b, lanes - lanes_at(in.rare[b / bond_block].anchored, b));
    if constexpr (column == Column::damage_normal) in.damaged[b / bond_block] = 1;
    to(values<column>(b), b, lanes);
  }
  BreakEvent in_si(BreakEvent event) const {
    const double sign = in.row_lo[event.bond] > in.row_hi[event.bond] ? -in.force : in.force;
    event.shear = sign * event.shear;
    event.plastic_stretch *= in.length;
    return event;
  }

private:
  static void to(float (&block)[bond_block], std::size_t b, const FloatLanes& lanes) {
    lanes.v.copy_to(block + b % bond_block, std::experimental::vector_aligned);
  }
  template <Column column>
  auto& values(std::size_t b) const {
    const std::size_t k = b / bond_block;
    if constexpr (column == Column::area) return in.bonds[k].area;
    if constexpr (column == Column::stiffness) return in.bonds[k].stiffness;
    if constexpr (column == Column::damping) return in.bonds[k].damping;
    if constexpr (column == Column::shear_x) return in.bonds[k].shear_x;
    if constexpr (column == Column::shear_y) return in.bonds[k].shear_y;
    if constexpr (column == Column::shear_z) return in.bonds[k].shear_z;
    if constexpr (column == Column::plastic_stretch) return in.rare[k].plastic_stretch;
    if constexpr (column == Column::damage_normal) return in.rare[k].damage_normal;
    if constexpr (column == Column::damage_shear) return in.rare[k].damage_shear;
    if constexpr (column == Column::spring_force) return in.ledger[k].spring_force;
    if constexpr (column == Column::viscous_force) return in.ledger[k].viscous_force;
    if constexpr (column == Column::shear_factor) return in.ledger[k].shear_factor;
  }
};

template <std::size_t... part>
inline constexpr std::index_sequence<part...> parts{};

/// Sums of integers of 32 bits.
struct IntegerRows {
  using Sum = IntRow;
  static constexpr std::size_t bytes_per_unit = sizeof(IntegerSums) / row_unit;  ///< of a row's address
  [[gnu::always_inline]] static IntRegister as_kept(const FloatLanes& a) { return nearest_integers(a); }
  [[gnu::always_inline]] static IntRow opposite(const IntRow& row) { return on_hi(row); }
  [[gnu::always_inline]] static void add(Sum& sum, const IntRow& row) { sum += row; }
};

/// The loads of a batch are added while the next one is worked out, a bond at a time: a processor
/// looks some 300 instructions ahead, a batch has 600.
template <class Rows>
class WaitingLoads {
public:
  /// @param sums  rows of Rows::Sum
  WaitingLoads(const SinglePassIn& in, void* sums) : in_(in), sums_(static_cast<char*>(sums)) {}

  /// Sixteenths of the batch.
  template <std::size_t... part>
  [[gnu::always_inline]] void add(std::index_sequence<part...>) const {
    const auto add_one = [&](std::size_t k) __attribute__((always_inline)) {
      if (k < float_width && near_) add_bond(k);
    };
    (add_one(part), ...);
  }
  [[gnu::always_inline]] void follow(std::size_t b, const Vec<FloatLanes>& force,
                                     const Vec<FloatLanes>& moment) {
    rows_ = rows_ == buffer_ ? buffer_ + float_width : buffer_;
    store_load_rows(force, moment, Rows::as_kept, rows_);
    if constexpr (std::is_same_v<Rows, IntegerRows>)
      if (in_.targets.atomic) return add_atomically(b);
    near_ = near_targets(b), far_ = far_targets(b);
  }
  void finish() const {
    for (std::size_t lane = 0; near_ && lane < float_width; ++lane) add_bond(lane);
  }

private:
  [[gnu::always_inline]] const Index* near_targets(std::size_t b) const {
    return in_.targets.near.empty() ? in_.bonds[b / bond_block].near + b % bond_block
                                    : in_.targets.near.data() + b;
  }
  [[gnu::always_inline]] const Index* far_targets(std::size_t b) const {
    return in_.targets.far.empty() ? in_.bonds[b / bond_block].far + b % bond_block
                                   : in_.targets.far.data() + b;
  }
  [[gnu::always_inline]] typename Rows::Sum& sum(Index row) const {
    return *reinterpret_cast<typename Rows::Sum*>(sums_ + Rows::bytes_per_unit * row);
  }
  [[gnu::always_inline]] void add_bond(std::size_t lane) const {
    const IntRow row = rows_[place_of_lane(lane)];
    Rows::add(sum(near_[lane]), row);
    Rows::add(sum(far_[lane]), Rows::opposite(row));  // (P3) (P18)
  }
  void add_atomically(std::size_t b) const {
    const auto add = [&](Index target, const IntRow& row) {
      IntRow& to = sum(target & ~shared_row);
      if (!(target & shared_row)) {
        to += row;
        return;
      }
      auto* numbers = reinterpret_cast<std::int32_t*>(&to);
      for (int k = 0; k < 8; ++k)
        if (k % 4 != 3)
          std::atomic_ref(numbers[k]).fetch_add(static_cast<std::int32_t>(row[k]), std::memory_order_relaxed);
    };
    for (std::size_t lane = 0; lane < float_width; ++lane) {
      const IntRow row = rows_[place_of_lane(lane)];
      add(near_targets(b)[lane], row), add(far_targets(b)[lane], on_hi(row));
    }
  }

  const SinglePassIn& in_;
  char* const sums_;
  alignas(64) IntRow buffer_[2 * float_width];
  IntRow* rows_ = buffer_;
  const Index *near_ = nullptr, *far_ = nullptr;
};

/// Loads of the lanes whose force is more than sums hold go to a list, and leave the registers.
/// @returns whether all of them are numbers
[[gnu::noinline, gnu::cold]] inline bool take_apart(const BondBlock& block, std::size_t first_lane,
                                                    const FloatLanes& limit, const FloatLanes& most,
                                                    Vec<FloatLanes>& force, Vec<FloatLanes>& moment,
                                                    std::vector<LoadApart>& apart) {
  constexpr double most_of_all = 0x1p58;  // sums of these are made in 64 bits
  bool numbers = true;
  for (std::size_t lane = 0; lane < float_width; ++lane) {
    if (most.v[lane] <= limit.v[lane]) continue;
    const auto widened = [&](const FloatLanes& a) {
      return static_cast<double>(static_cast<float>(a.v[lane]));
    };
    if (!(widened(most) < most_of_all)) {
      numbers = false;
      continue;
    }
    const std::size_t at = first_lane + lane;
    apart.push_back({block.near[at] / row_unit,
                     block.far[at] / row_unit,
                     {widened(force.x), widened(force.y), widened(force.z)},
                     {widened(moment.x), widened(moment.y), widened(moment.z)}});
  }
  const auto fits = most <= limit;
  const FloatLanes none(0.0);
  force = select(fits, force, {none, none, none});
  moment = select(fits, moment, {none, none, none});
  return numbers;
}

/// Asks for the far ends of a later batch, 64 bonds on: some 250 ns.
template <class Rows>
[[gnu::always_inline]] inline void prefetch_ends(const SinglePassIn& in, const void* all_sums,
                                                 std::size_t b) {
  constexpr std::size_t ahead = 64;
  const std::size_t later = std::min(b + ahead, bond_block * in.bonds.size() - float_width);
  const Index* const rows = in.bonds[later / bond_block].far + later % bond_block;
  const char* const motion = reinterpret_cast<const char*>(in.motion.data());
  const char* const sums = static_cast<const char*>(all_sums);
  for (std::size_t lane = 0; lane < float_width; ++lane) {
    __builtin_prefetch(motion + std::size_t{8} * rows[lane]);
    __builtin_prefetch(sums + Rows::bytes_per_unit * rows[lane], 1);
  }
}

template <class In>
[[gnu::always_inline]] inline EndColumns<FloatLanes> ends_of(const In& in, std::size_t b) {
  const BondBlock& block = in.bonds[b / bond_block];
  const Index *const near = block.near + b % bond_block, *const far = block.far + b % bond_block;
  const char* const motion = reinterpret_cast<const char*>(in.motion.data());
  const auto record = [&](Index row) __attribute__((always_inline)) {
    return reinterpret_cast<const std::int32_t*>(motion + std::size_t{8} * row);
  };
  return columns_of_ends<EndColumns<FloatLanes>>(
      [&](std::size_t k) __attribute__((always_inline)) { return record(near[k]); },
      [&](std::size_t k) __attribute__((always_inline)) { return record(far[k]); });
}

/// Bonds in which more than springs and dashpots may act, if they are not damaged.
template <Features features, class Law>
[[gnu::always_inline]] inline FloatLanes::Mask may_change(const Law& law,
                                                          const BondConstants<FloatLanes>& bond,
                                                          const FloatLanes& stretch,
                                                          const FloatLanes& elastic, const FloatLanes& normal,
                                                          const Vec<FloatLanes>& shear) {
  FloatLanes::Mask may(false);
  if constexpr (features.plasticity) may = may_yield(law, bond, stretch, elastic);
  if constexpr (features.breakage)
    may = may || may_fail<features.criterion == Criterion::coupled>(law.failure, limits_of(law, bond), normal,
                                                                    dot(shear, shear));
  return may;
}

/// Whether the law of a batch without damage may be left out.
template <Features features, class Law>
inline constexpr bool has_short_way = !features.unloading && !features.several;

/// Bonds [first, last). To be flattened by the caller (see bond_loop.hpp).
/// @param sums  rows of Rows::Sum
/// @returns SingleEvent bits
template <Features features, class Rows = IntegerRows, class Law>
[[gnu::always_inline]] inline unsigned single_loop(const Law& law, const SinglePassIn& in, void* sums,
                                                   std::size_t first, std::size_t last, BreakNotes* notes,
                                                   std::vector<LoadApart>& apart) {
  const BlockBonds bonds{in};
  WaitingLoads<Rows> waiting(in, sums);
  const FloatLanes limit(in.force_limit), finer(in.moved / in.length);
  const bool ledger = !in.ledger.empty();
  bool large = false, lost = false;
  while (first < last) {
    const std::size_t end = std::min(first + ForceBuffer::capacity, last);
    BondLosses<FloatLanes> loss{};
    for (std::size_t b = first; b < end; b += float_width) {
      prefetch_ends<Rows>(in, sums, b);
      const BondBlock& block = in.bonds[b / bond_block];
      const RareBlock& rare = in.rare[b / bond_block];
      const EndColumns<FloatLanes> ends = ends_of(in, b);
      waiting.add(parts<0, 1>);
      const PairMotion<FloatLanes> pair = motion_of(ends, lanes_at(block.per_radii, b), finer);
      waiting.add(parts<2, 3, 4>);
      BondConstants<FloatLanes> bond{pair.anchor_distance, bonds.load<Column::area>(b),
                                     bonds.load<Column::strength_area>(b), bonds.load<Column::stiffness>(b),
                                     FloatLanes(0.0)};
      if constexpr (features.contact_damping) bond.damping = bonds.load<Column::damping>(b);
      const Vec<FloatLanes> before{bonds.load<Column::shear_x>(b), bonds.load<Column::shear_y>(b),
                                   bonds.load<Column::shear_z>(b)};
      const FloatLanes k_s = shear_stiffness_of(law, b, bond.stiffness);
      const Vec<FloatLanes> trial = trial_shear<features.rotation>(pair, before, k_s);
      waiting.add(parts<5, 6, 7>);
      const FloatLanes elastic = pair.longer - lanes_at(block.plastic, b);
      const FloatLanes normal = bond.stiffness * elastic;
      Vec<FloatLanes> shear = trial;
      FloatLanes total = normal;
      if constexpr (features.contact_damping) total += bond.damping * pair.rate;
      waiting.add(parts<8, 9>);
      // most laws need it on the long way alone
      const auto stretch = [&] { return pair.longer + lanes_at(rare.anchored, b); };
      FloatLanes::Mask acts(true);  // the law, and not springs and dashpots alone
      bool short_way = false;
      if constexpr (has_short_way<features, Law>) {
        acts = may_change<features>(law, bond, stretch(), elastic, normal, trial);
        short_way = in.damaged[b / bond_block] == 0 && !any(acts);
      }
      if (short_way) [[likely]] {
        bonds.store<Column::shear_x>(b, trial.x);
        bonds.store<Column::shear_y>(b, trial.y);
        bonds.store<Column::shear_z>(b, trial.z);
        if constexpr (features.contact_damping)
          if (ledger) keep_viscous_loss(FloatLanes(total - normal), elongation_of(pair), bonds, b, loss);
      } else {
        const BondHistory<FloatLanes> was = history_of<features, FloatLanes>(bonds, b);
        BondHistory<FloatLanes> h = was;
        h.shear = trial;
        const BondStrain<FloatLanes> strain{stretch(), elastic, pair.rate, pair.rate,
                                            slip_of<features.rotation>(pair)};
        const Vec<FloatLanes> rotated = trial - k_s * strain.slip;
        BondAction<FloatLanes> action = act_on_batch<features>(law, b, bond, strain, rotated, h);
        if constexpr (has_short_way<features, Law>) {
          // the others as on the short way, to the last bit: who shares a register is chance
          if constexpr (features.breakage) acts = acts || damaged_lanes(was);
          h.shear = select(acts, h.shear, trial);
          action.shear = select(acts, action.shear, trial);
          action.along = select(acts, action.along, total);
        }
        keep_history<features>(bonds, h, was, b, notes);
        if (ledger)
          keep_losses<features>(law, bond, strain, elongation_of(pair), was, h, action, bonds, b, loss);
        total = action.along, shear = action.shear;
      }
      waiting.add(parts<10, 11>);
      const Vec<FloatLanes> force = force_of(pair, total, shear);
      waiting.add(parts<12, 13>);
      Vec<FloatLanes> moment{FloatLanes(0.0), FloatLanes(0.0), FloatLanes(0.0)};
      if constexpr (features.rotation) moment = moment_of(pair, shear);
      waiting.add(parts<14, 15>);
      const FloatLanes most = larger(magnitude(force.x), larger(magnitude(force.y), magnitude(force.z)));
      if (any(!(most <= limit))) [[unlikely]] {
        Vec<FloatLanes> left = force, turns = moment;
        large = true, lost = !take_apart(block, b % bond_block, limit, most, left, turns, apart) || lost;
        waiting.follow(b, left, turns);
        continue;
      }
      waiting.follow(b, force, moment);
    }
    if (ledger) add_lanes(loss, in.length * in.force, in.losses[first / ForceBuffer::capacity]);
    first = end;
  }
  waiting.finish();
  return (large ? force_is_large : 0u) | (lost ? force_is_lost : 0u);
}

}  // namespace
}  // namespace breccia::BRECCIA_ISA
