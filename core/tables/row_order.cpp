#include "core/tables/row_order.hpp"

#include <compare>

#include "core/base/threads.hpp"

namespace breccia {
namespace {

/// What a row is sorted by, beside its number: millions of them are sorted where they lie.
struct Key {
  Gid lo, hi;
  Row row;
  auto operator<=>(const Key&) const = default;
};

template <class KeyOf>
std::vector<Row> sorted(std::size_t first, std::size_t last, const KeyOf& key_of) {
  std::vector<Key> keys(last - first);
  for (std::size_t k = 0; k < keys.size(); ++k) keys[k] = key_of(static_cast<Row>(first + k));
  sort_on_threads(keys.begin(), keys.end());
  std::vector<Row> rows(keys.size());
  for (std::size_t k = 0; k < keys.size(); ++k) rows[k] = keys[k].row;
  return rows;
}

template <class Pairs>
std::vector<Row> by_ends(const Pairs& pairs) {
  return sorted(0, pairs.size, [&](Row row) { return Key{pairs.gid_lo[row], pairs.gid_hi[row], row}; });
}

}  // namespace

std::vector<Row> rows_by_gid(const ParticleTable& particles, std::size_t first, std::size_t last) {
  return sorted(first, last, [&](Row row) { return Key{particles.gid[row], 0, row}; });
}

std::vector<Row> rows_by_gid(const ParticleTable& particles) {
  return rows_by_gid(particles, 0, particles.size);
}

std::vector<Row> rows_by_ends(const BondTable& bonds) { return by_ends(bonds); }

std::vector<Row> rows_by_ends(const ContactTable& contacts) { return by_ends(contacts); }

}  // namespace breccia
