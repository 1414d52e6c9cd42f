// The order in which rows leave the program, over all ranks: by global ids, whatever the order in
// memory, threads and ranks are. Each rank writes one part of that order, and first gets its rows
// from those that own them.
#pragma once
#include <vector>

#include "core/ranks/partition.hpp"
#include "core/tables/bond_table.hpp"
#include "core/tables/contact_table.hpp"
#include "core/tables/particle_table.hpp"

namespace breccia {

struct FileOrder {
  Ranks ranks;
  std::size_t total = 0;              ///< rows of all ranks
  std::size_t first = 0;              ///< that this rank writes
  std::vector<Row> give;              ///< rows that this rank owns, in the order of ids
  std::vector<std::size_t> to, from;  ///< of several ranks: how many of them each one writes, and gives
  std::vector<std::size_t> place;     ///< of several ranks: of what comes in, within the part
};

FileOrder file_order(const Partition& partition, const ParticleTable& particles);
/// Of the rows [0, size), which are those that a rank owns; by both ids.
FileOrder file_order(const Partition& partition, const BondTable& bonds);
FileOrder file_order(const Partition& partition, const ContactTable& contacts);

/// The part of a column that this rank writes: value(row) of the rows that lie there. T is copied
/// as it lies.
template <class T, class Value>
std::vector<T> in_file_order(const FileOrder& order, const Value& value) {
  std::vector<T> given;
  given.reserve(order.give.size());
  for (const Row row : order.give) given.push_back(value(row));
  if (order.ranks.alone()) return given;
  std::vector<T> came(order.place.size()), part(came.size());
  all_to_all(sizeof(T), given.data(), order.to, came.data(), order.from);
  for (std::size_t k = 0; k < came.size(); ++k) part[order.place[k]] = came[k];
  return part;
}

}  // namespace breccia
