#include "core/ranks/file_order.hpp"

#include <algorithm>
#include <compare>
#include <numeric>

#include "core/base/threads.hpp"
#include "core/tables/row_order.hpp"

namespace breccia {
namespace {

struct Ids {
  Gid lo, hi;
  auto operator<=>(const Ids&) const = default;
};

/// Of each part but the first, the ids that it begins with. Ranks give samples by their rows, some
/// 256 to a part, so that parts are even to within a few of them.
std::vector<Ids> first_ids_of_parts(const Ranks& ranks, std::span<const Ids> mine) {
  const auto parts = static_cast<std::size_t>(ranks.count);
  const std::size_t total = std::max<std::size_t>(1, all_reduce_sum(ranks, mine.size()));
  const std::size_t count = std::min(mine.size(), (256 * parts * mine.size() + total - 1) / total);
  std::vector<Ids> samples;
  for (std::size_t k = 0; k < count; ++k) samples.push_back(mine[k * mine.size() / count]);
  samples = gather_elements_everywhere(ranks, std::span<const Ids>(samples));
  std::sort(samples.begin(), samples.end());
  std::vector<Ids> firsts;
  for (std::size_t part = 1; part < parts && !samples.empty(); ++part)
    firsts.push_back(samples[part * samples.size() / parts]);
  return firsts;
}

/// Sorts by samples (Blelloch et al., SPAA 1991): each rank has its rows in order already, hands
/// every other one those of its part, and puts what it gets in order.
/// @param own  rows of this rank, in the order of ids
template <class IdsOf>
FileOrder order_of(const Ranks& ranks, std::vector<Row> own, const IdsOf& ids_of) {
  FileOrder order;
  order.ranks = ranks;
  order.give = std::move(own);
  order.total = order.give.size();
  if (ranks.alone()) return order;

  std::vector<Ids> ids;
  ids.reserve(order.give.size());
  for (const Row row : order.give) ids.push_back(ids_of(row));
  auto from = ids.begin();
  for (const Ids& first : first_ids_of_parts(ranks, ids)) {
    const auto end = std::lower_bound(from, ids.end(), first);
    order.to.push_back(static_cast<std::size_t>(end - from));
    from = end;
  }
  order.to.resize(static_cast<std::size_t>(ranks.count), static_cast<std::size_t>(ids.end() - from));
  order.from = sizes_for_me(order.to);

  struct Arrival {
    Ids ids;
    std::size_t at;
    auto operator<=>(const Arrival&) const = default;
  };
  std::vector<Ids> came(std::accumulate(order.from.begin(), order.from.end(), std::size_t{0}));
  all_to_all(sizeof(Ids), ids.data(), order.to, came.data(), order.from);
  std::vector<Arrival> arrivals(came.size());
  for (std::size_t k = 0; k < came.size(); ++k) arrivals[k] = {came[k], k};
  sort_on_threads(arrivals.begin(), arrivals.end());
  order.place.resize(came.size());
  for (std::size_t k = 0; k < arrivals.size(); ++k) order.place[arrivals[k].at] = k;

  const std::vector<std::size_t> parts = sizes_of_all(ranks, came.size());
  order.first = std::accumulate(parts.begin(), parts.begin() + ranks.rank, std::size_t{0});
  order.total = std::accumulate(parts.begin(), parts.end(), std::size_t{0});
  return order;
}

template <class Pairs>
FileOrder order_of_pairs(const Partition& partition, const Pairs& pairs) {
  return order_of(partition.ranks, rows_by_ends(pairs), [&](Row row) {
    return Ids{pairs.gid_lo[row], pairs.gid_hi[row]};
  });
}

}  // namespace

FileOrder file_order(const Partition& partition, const ParticleTable& particles) {
  const Rows own = partition.owned();
  return order_of(partition.ranks, rows_by_gid(particles, own.first, own.last), [&](Row row) {
    return Ids{particles.gid[row], 0};
  });
}

FileOrder file_order(const Partition& partition, const BondTable& bonds) {
  return order_of_pairs(partition, bonds);
}

FileOrder file_order(const Partition& partition, const ContactTable& contacts) {
  return order_of_pairs(partition, contacts);
}

}  // namespace breccia
