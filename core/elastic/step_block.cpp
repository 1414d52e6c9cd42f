#include "core/elastic/step_block.hpp"

#include "core/tables/part_of_table.hpp"

namespace breccia {
namespace {

/// Calls visit(lo, hi) for all pairs of both tables.
template <class Visit>
void each_pair(const StepScene& s, const Visit& visit) {
  for (std::size_t k = 0; k < s.bonds.size; ++k) visit(s.bonds.row_lo[k], s.bonds.row_hi[k]);
  for (std::size_t k = 0; k < s.contacts.size; ++k) visit(s.contacts.row_lo[k], s.contacts.row_hi[k]);
}

/// By row: whether it lies within so many pairs of the contacts.
std::vector<std::uint8_t> rows_within(const StepScene& s, std::span<const std::size_t> contacts, int pairs) {
  std::vector<std::uint8_t> inside(s.particles.size, 0);
  for (const std::size_t k : contacts) inside[s.contacts.row_lo[k]] = inside[s.contacts.row_hi[k]] = 1;
  for (; pairs > 0; --pairs) {
    std::vector<std::uint8_t> wider = inside;
    each_pair(s, [&](Row lo, Row hi) {
      if (inside[lo] || inside[hi]) wider[lo] = wider[hi] = 1;
    });
    inside = std::move(wider);
  }
  return inside;
}

/// The pairs of a table that a free row has.
template <class Table>
Table pairs_of(const Table& whole, std::span<const std::uint8_t> free) {
  std::vector<std::size_t> rows;
  for (std::size_t k = 0; k < whole.size; ++k)
    if (free[whole.row_lo[k]] || free[whole.row_hi[k]]) rows.push_back(k);
  return part_of_table(whole, rows, rows.size());
}

}  // namespace

StepScene StepBlock::scene(const StepScene& whole) const {
  return {.particles = particles,
          .bonds = bonds,
          .contacts = contacts,
          .dashpots = dashpots,
          .shear_ratio = whole.shear_ratio,
          .global_damping = whole.global_damping,
          .reach = whole.reach,
          .freedom = whole.freedom,
          .threads = 1,
          .fixed = fixed};
}

StepBlock block_around(const StepScene& whole, std::span<const std::size_t> near, int bonds) {
  const std::vector<std::uint8_t> free = rows_within(whole, near, bonds);
  StepBlock block{.particles = {},
                  .bonds = pairs_of(whole.bonds, free),
                  .contacts = pairs_of(whole.contacts, free),
                  .dashpots = whole.dashpots,
                  .fixed = {}};
  std::vector<std::uint8_t> taken = free;
  each_pair(whole, [&](Row lo, Row hi) {
    if (free[lo] || free[hi]) taken[lo] = taken[hi] = 1;
  });
  std::vector<Row> place(whole.particles.size), rows;
  for (std::size_t row = 0; row < taken.size(); ++row) {
    if (!taken[row]) continue;
    place[row] = static_cast<Row>(rows.size());
    rows.push_back(static_cast<Row>(row));
    block.fixed.push_back(free[row] ? 0 : 1);
  }
  ParticleTable& p = block.particles;
  p.resize(rows.size(), Features{});
  block.dashpots.load.clear();
  for (std::size_t k = 0; k < rows.size(); ++k) {
    p.position[k] = whole.particles.position[rows[k]];
    p.mass[k] = whole.particles.mass[rows[k]];
    p.radius[k] = whole.particles.radius[rows[k]];
    if (!whole.dashpots.load.empty()) block.dashpots.load.push_back(whole.dashpots.load[rows[k]]);
  }
  const auto renumber = [&](auto& table) {
    for (std::size_t k = 0; k < table.size; ++k)
      table.row_lo[k] = place[table.row_lo[k]], table.row_hi[k] = place[table.row_hi[k]];
  };
  renumber(block.bonds), renumber(block.contacts);
  return block;
}

}  // namespace breccia
