#include "core/world/single_precision.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>

#include "core/base/threads.hpp"
#include "core/boundary/loose_surface.hpp"
#include "core/world/loop_views.hpp"

namespace breccia {
namespace {

std::int32_t wrapping_sum(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
}

/// Those of a range that have moved far.
void note_far(World& w, std::size_t first, std::size_t last) {
  for (std::size_t row = first; row < last; ++row)
    if (is_far(w.single, row)) w.single.moved_far.push_back(static_cast<Row>(row));
}

}  // namespace

std::optional<std::size_t> bond_too_short_for_single(const BondTable& b) {
  if (b.size == 0) return std::nullopt;
  const auto last = b.rest_length.begin() + static_cast<std::ptrdiff_t>(b.size);
  const auto shortest = std::min_element(b.rest_length.begin(), last);
  if (*shortest >= shortest_told(b)) return std::nullopt;
  return static_cast<std::size_t>(shortest - b.rest_length.begin());
}

void start_single(World& w) {
  if (w.options.precision != Precision::single) return;
  w.single.quanta = choose_quanta(w.particles, w.bonds, w.dt);
  set_anchors(w.single.quanta, w.particles, w.dt);
  fill_single(w);
}

void fill_single(World& w) {
  if (w.options.precision != Precision::single) return;
  fill(w.single, w.particles, w.bonds, w.laws, w.dt);
  set_targets(w.single, w.bond_plan.to_lo, w.bond_plan.to_hi, w.bond_plan.slot_count, w.bonds);
}

void forget_blocks(SingleStore& s) {
  const SingleStore before = std::move(s);
  s = {};
  s.quanta = before.quanta, s.renewals = before.renewals, s.coarsenings = before.coarsenings;
}

void pass_in_single(World& w, const std::function<void(const SingleRange&)>& for_bonds) {
  const SinglePassIn in = single_pass_in(w);
  std::atomic<unsigned> events = 0;
  std::mutex adds;
  for_bonds([&](std::size_t first, std::size_t last, BreakNotes* notes) {
    std::vector<LoadApart> apart;
    events |= w.single_pass(in, first, last, notes, apart);
    if (apart.empty()) return;
    const std::scoped_lock lock(adds);
    w.single.apart.insert(w.single.apart.end(), apart.begin(), apart.end());
  });
  w.single.events |= events;
}

void add_slots(SingleStore& s, const ScatterPlan& plan) {
  for (std::size_t k = 0; k < plan.shared.size(); ++k) {
    IntegerSums& to = s.sums[plan.shared[k]];
    for (Index slot = plan.first_slot[k]; slot < plan.first_slot[k + 1]; ++slot) {
      IntegerSums& from = s.sums[plan.slots[slot]];
      for (int c = 0; c < 3; ++c) {
        to.force[c] = wrapping_sum(to.force[c], from.force[c]);
        to.moment[c] = wrapping_sum(to.moment[c], from.moment[c]);
      }
      from = {};
    }
  }
}

void collect_single(World& w) {
  SingleStore& s = w.single;
  add_slots(s, w.bond_plan);
  const Rows mine = w.partition.owned();
  add_apart(s, w.particles, mine.first, mine.last);
  const Rows held =
      looks_at_all(w.confinement, w.step) ? mine : w.partition.owned(w.particles.free, w.particles.size);
  const CollectedSums sums = collected_sums(w);
  for_rows(held.last - held.first, w.options.threads, [&](std::size_t first, std::size_t last) {
    w.collect_sums(sums, held.first + first, held.first + last);
  });
  if (w.confinement.rigid || w.confinement.acts()) collect_rows(w, w.confinement.rows);
  // what was added to the others' particles, they add themselves
  for (const Neighbour& n : w.partition.neighbours)
    for (const Row row : n.receive) s.sums[row] = {};
}

void collect_rows(World& w, std::span<const Row> rows) {
  if (w.single.empty()) return;
  const CollectedSums sums = collected_sums(w);
  for_owned_entries(w.partition, rows, [&](std::size_t k) { w.collect_sums(sums, rows[k], rows[k] + 1); });
}

void record_motion(World& w, unsigned events) {
  if (w.single.empty()) return;
  const Rows held = w.partition.owned(w.particles.free, w.particles.size), mine = w.partition.owned();
  w.single.events = events;
  events |= w.refresh_records(recorded_motion(w), held.first, held.last, w.dt);
  if (events & place_is_far) note_far(w, mine.first, mine.last);
  w.single.ghosts_are_current = false;
}

void renew_far(World& w) {
  if (w.single.moved_far.empty()) return;
  const Lap lap(w.phases, Phase::integrate);
  renew_anchors(w.single, w.particles, w.bonds);
}

void record_ghosts(World& w) {
  if (w.single.empty() || w.single.ghosts_are_current) return;
  // what happens to them their owners report
  const RecordedMotion motion = recorded_motion(w);
  for (const Neighbour& n : w.partition.neighbours)
    for (const Row row : n.receive)
      if (w.refresh_records(motion, row, row + 1, w.dt) & place_is_far) note_far(w, row, row + 1);
  w.single.ghosts_are_current = true;
}

}  // namespace breccia
