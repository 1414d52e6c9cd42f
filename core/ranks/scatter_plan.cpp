#include "core/ranks/scatter_plan.hpp"

#include <algorithm>
#include <limits>

#include "core/base/threads.hpp"

namespace breccia {
namespace {

constexpr int nobody = -1, several = -2;

/// The one range that touches each particle, or `several`.
std::vector<int> owners(const ScatterPlan& plan, std::span<const Index> row_lo, std::span<const Index> row_hi,
                        std::size_t particles) {
  std::vector<int> owner(particles, nobody);
  for (int range = 0; range < plan.ranges; ++range)
    for (std::size_t b = plan.first(range); b < plan.first(range + 1); ++b)
      for (const Index row : {row_lo[b], row_hi[b]})
        owner[row] = owner[row] == nobody || owner[row] == range ? range : several;
  return owner;
}

void plan_private(ScatterPlan& plan, std::span<const Index> row_lo, std::span<const Index> row_hi,
                  const std::vector<int>& owner) {
  constexpr Index none = std::numeric_limits<Index>::max();
  std::vector<std::pair<Index, Index>> slot_of;  // particle, slot; slots rise with the range
  std::vector<Index> mine(owner.size(), none);
  auto next = static_cast<Index>(owner.size());
  for (int range = 0; range < plan.ranges; ++range) {
    const std::size_t begin = slot_of.size();
    const auto target = [&](Index row) {
      if (owner[row] != several) return row;
      if (mine[row] == none) {
        mine[row] = next++;
        slot_of.emplace_back(row, mine[row]);
      }
      return mine[row];
    };
    for (std::size_t b = plan.first(range); b < plan.first(range + 1); ++b) {
      plan.to_lo[b] = target(row_lo[b]);
      plan.to_hi[b] = target(row_hi[b]);
    }
    for (std::size_t k = begin; k < slot_of.size(); ++k) mine[slot_of[k].first] = none;
  }
  std::sort(slot_of.begin(), slot_of.end());
  plan.slot_count = slot_of.size();
  for (const auto& [row, slot] : slot_of) {
    if (plan.shared.empty() || plan.shared.back() != row) {
      plan.shared.push_back(row);
      plan.first_slot.push_back(static_cast<Index>(plan.slots.size()));
    }
    plan.slots.push_back(slot);
  }
  plan.first_slot.push_back(static_cast<Index>(plan.slots.size()));
}

void plan_gather(ScatterPlan& plan, std::span<const Index> row_lo, std::span<const Index> row_hi,
                 std::span<const Gid> gid_lo, std::span<const Gid> gid_hi, std::span<const double> arm_offset,
                 std::size_t particles) {
  plan.first_entry.assign(particles + 1, 0);
  const auto is_padding = [&](std::size_t b) { return gid_lo[b] == gid_hi[b]; };
  for (std::size_t b = 0; b < gid_lo.size(); ++b) {
    if (is_padding(b)) continue;
    ++plan.first_entry[row_lo[b] + 1];
    ++plan.first_entry[row_hi[b] + 1];
  }
  for (std::size_t p = 0; p < particles; ++p) plan.first_entry[p + 1] += plan.first_entry[p];
  plan.entries.resize(plan.first_entry.back());
  std::vector<Index> next(plan.first_entry.begin(), plan.first_entry.end() - 1);
  for (std::size_t b = 0; b < gid_lo.size(); ++b) {
    if (is_padding(b)) continue;
    plan.entries[next[row_lo[b]]++] = static_cast<Index>(b << 1);
    plan.entries[next[row_hi[b]]++] = static_cast<Index>(b << 1 | 1u);
  }
  for (std::size_t p = 0; p < particles; ++p)
    std::sort(plan.entries.begin() + plan.first_entry[p], plan.entries.begin() + plan.first_entry[p + 1],
              [&](Index a, Index b) {
                const auto other = [&](Index e) { return e & 1u ? gid_lo[e >> 1] : gid_hi[e >> 1]; };
                return other(a) < other(b);
              });
  if (arm_offset.empty()) return;
  for (const Index e : plan.entries)
    plan.entry_share.push_back(0.5 + (e & 1u ? -arm_offset[e >> 1] : arm_offset[e >> 1]));
}

}  // namespace

std::size_t ScatterPlan::first(int range) const { return range_first(rows, range, ranges, batch); }

ScatterPlan plan_scatter(ScatterKind kind, int ranges, std::size_t batch, std::span<const Index> row_lo,
                         std::span<const Index> row_hi, std::span<const Gid> gid_lo,
                         std::span<const Gid> gid_hi, std::span<const double> arm_offset,
                         std::size_t particles) {
  ScatterPlan plan;
  plan.kind = kind;
  plan.ranges = ranges;
  plan.batch = batch;
  plan.rows = row_lo.size();
  if (kind == ScatterKind::gather) {
    plan_gather(plan, row_lo, row_hi, gid_lo, gid_hi, arm_offset, particles);
    plan.bond_load.resize(plan.rows);
    return plan;
  }
  if (ranges <= 1) return plan;
  const std::vector<int> owner = owners(plan, row_lo, row_hi, particles);
  plan.to_lo.assign(row_lo.begin(), row_lo.end());
  plan.to_hi.assign(row_hi.begin(), row_hi.end());
  if (kind == ScatterKind::private_sums) {
    plan_private(plan, row_lo, row_hi, owner);
  } else {
    for (std::size_t b = 0; b < plan.rows; ++b) {
      if (owner[row_lo[b]] == several) plan.to_lo[b] |= shared_row;
      if (owner[row_hi[b]] == several) plan.to_hi[b] |= shared_row;
    }
  }
  return plan;
}

Scatter scatter_view(ScatterPlan& plan, std::span<const Index> row_lo, std::span<const Index> row_hi,
                     std::span<const double> arm_offset, ParticleTable& particles) {
  Scatter view;
  view.mode = plan.kind == ScatterKind::gather                      ? ScatterMode::column
              : plan.kind == ScatterKind::atomic && plan.ranges > 1 ? ScatterMode::atomic
                                                                    : ScatterMode::own;
  view.to_lo = plan.to_lo.empty() ? row_lo : std::span<const Index>(plan.to_lo);
  view.to_hi = plan.to_hi.empty() ? row_hi : std::span<const Index>(plan.to_hi);
  view.arm_offset = arm_offset;
  // the ranges' own sums are rows past the particles
  if (particles.force.size() < particles.size + plan.slot_count)
    particles.extend_sums(particles.size + plan.slot_count);
  view.force = particles.force;
  view.torque = particles.torque;
  view.bond_load = plan.bond_load;
  return view;
}

Scatter couple_view(ScatterPlan& plan, std::span<const Index> row_lo, std::span<const Index> row_hi,
                    ParticleTable& particles) {
  Scatter view = scatter_view(plan, row_lo, row_hi, {}, particles);
  if (plan.kind == ScatterKind::gather && plan.couples.empty()) plan.couples.resize(plan.rows);
  view.bond_load = plan.couples;
  return view;
}

void collect(ScatterPlan& plan, ParticleTable& particles, Rows own, int threads) {
  const bool torques = !particles.spin.empty();
  if (plan.kind == ScatterKind::gather) {
    for_rows(own.last - own.first, threads, [&](std::size_t first, std::size_t last) {
      for (std::size_t p = own.first + first; p < own.first + last; ++p) {
        Vec3 force, torque;
        for (Index e = plan.first_entry[p]; e < plan.first_entry[p + 1]; ++e) {
          const Index entry = plan.entries[e];
          const BondLoad& load = plan.bond_load[entry >> 1];
          force += (entry & 1u ? -1.0 : 1.0) * load.force;
          if (torques) torque += plan.entry_share[e] * load.moment;
          if (!plan.couples.empty()) torque += (entry & 1u ? -1.0 : 1.0) * plan.couples[entry >> 1].force;
        }
        particles.force[p] += force;
        if (torques) particles.torque[p] += torque;
      }
    });
    return;
  }
  if (plan.shared.empty()) return;
  for_rows(plan.shared.size(), threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      const Index row = plan.shared[k];
      for (Index s = plan.first_slot[k]; s < plan.first_slot[k + 1]; ++s) {
        particles.force[row] += particles.force[plan.slots[s]];
        particles.force[plan.slots[s]] = {};
        if (!torques) continue;
        particles.torque[row] += particles.torque[plan.slots[s]];
        particles.torque[plan.slots[s]] = {};
      }
    }
  });
}

}  // namespace breccia
