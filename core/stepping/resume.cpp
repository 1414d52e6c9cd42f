#include "core/stepping/resume.hpp"

#include <algorithm>
#include <numeric>

#include "core/base/error.hpp"
#include "core/bonding/several_materials.hpp"
#include "core/tables/row_order.hpp"
#include "core/world/loop_views.hpp"
#include "core/world/scatter_plans.hpp"
#include "core/world/single_precision.hpp"
#include "core/world/stable_step.hpp"

namespace breccia {
namespace {

Row row_of(const ParticleTable& p, std::span<const Row> by_gid, Gid gid) {
  const auto at = std::lower_bound(by_gid.begin(), by_gid.end(), gid,
                                   [&](Row row, Gid wanted) { return p.gid[row] < wanted; });
  if (at == by_gid.end() || p.gid[*at] != gid) fail<BadInput>("the specimen has no particle {}", gid);
  return *at;
}

}  // namespace

std::vector<Row> list_contacts(World& w, std::span<const Gid> lo, std::span<const Gid> hi) {
  const ParticleTable& p = w.particles;
  const std::vector<Row> by_gid = rows_by_gid(p);
  std::vector<std::pair<Row, Row>> ends;
  for (std::size_t k = 0; k < lo.size(); ++k)
    ends.emplace_back(row_of(p, by_gid, lo[k]), row_of(p, by_gid, hi[k]));
  std::vector<Row> order(lo.size());
  std::iota(order.begin(), order.end(), Row{0});
  std::sort(order.begin(), order.end(), [&](Row a, Row b) {
    return std::minmax(ends[a].first, ends[a].second) < std::minmax(ends[b].first, ends[b].second);
  });
  ContactTable& c = w.contacts;
  c = contact_table(lo.size(), contact_columns(w));
  std::vector<Row> rows(lo.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    rows[order[k]] = static_cast<Row>(k);
    const auto [row_lo, row_hi] = ends[order[k]];
    c.gid_lo[k] = lo[order[k]];
    c.gid_hi[k] = hi[order[k]];
    c.row_lo[k] = row_lo;
    c.row_hi[k] = row_hi;
    if (!c.law.empty()) c.law[k] = law_between(p.material[row_lo], p.material[row_hi], w.materials);
    if (!c.arm_offset.empty()) c.arm_offset[k] = contact_arm_offset(p.radius[row_lo], p.radius[row_hi]);
  }
  return rows;
}

void restore(World& w) {
  set_dashpots(w);
  fill_single(w);
  plan_contacts(w);
}

}  // namespace breccia
