#include "core/row_order.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace breccia {
namespace {

std::vector<Row> first_rows(std::size_t size) {
  std::vector<Row> rows(size);
  std::iota(rows.begin(), rows.end(), Row{0});
  return rows;
}

template <class Pairs>
std::vector<Row> by_ends(const Pairs& pairs) {
  std::vector<Row> rows = first_rows(pairs.size);
  const auto ends = [&](Row row) { return std::tuple(pairs.gid_lo[row], pairs.gid_hi[row], row); };
  std::sort(rows.begin(), rows.end(), [&](Row a, Row b) { return ends(a) < ends(b); });
  return rows;
}

}  // namespace

std::vector<Row> rows_by_gid(const ParticleTable& particles) {
  std::vector<Row> rows = first_rows(particles.size);
  std::sort(rows.begin(), rows.end(), [&](Row a, Row b) { return particles.gid[a] < particles.gid[b]; });
  return rows;
}

std::vector<Row> rows_by_ends(const BondTable& bonds) { return by_ends(bonds); }

std::vector<Row> rows_by_ends(const ContactTable& contacts) { return by_ends(contacts); }

}  // namespace breccia
