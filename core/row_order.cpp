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

}  // namespace

std::vector<Row> rows_by_gid(const ParticleTable& particles) {
  std::vector<Row> rows = first_rows(particles.size);
  std::sort(rows.begin(), rows.end(), [&](Row a, Row b) { return particles.gid[a] < particles.gid[b]; });
  return rows;
}

std::vector<Row> rows_by_ends(const BondTable& bonds) {
  std::vector<Row> rows = first_rows(bonds.size);
  const auto ends = [&](Row row) { return std::tuple(bonds.gid_lo[row], bonds.gid_hi[row], row); };
  std::sort(rows.begin(), rows.end(), [&](Row a, Row b) { return ends(a) < ends(b); });
  return rows;
}

}  // namespace breccia
