#include "core/bonding/section_area.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace breccia {

double area_through(const ParticleTable& p, const BondTable& b, std::span<const double> area, double level) {
  if (area.size() < b.size)
    fail<BadInput>("area through a level: {} areas for {} bonds", area.size(), b.size);
  double sum = 0.0;
  for (std::size_t k = 0; k < b.size; ++k) {
    const Vec3 &x = p.reference_position[b.row_lo[k]], &y = p.reference_position[b.row_hi[k]];
    if ((x.z < level) == (y.z < level)) continue;
    const Vec3 d = y - x;
    sum += area[k] * std::abs(d.z) / norm(d);
  }
  return sum;
}

AreaThroughLevels area_through_levels(const ParticleTable& p, const BondTable& b,
                                      std::span<const double> area, double low, double high, int levels) {
  if (levels < 1) fail<BadInput>("area through levels: {} levels; ask for one at least", levels);
  AreaThroughLevels a;
  for (int k = 0; k < levels; ++k) {
    const double share = levels > 1 ? static_cast<double>(k) / (levels - 1) : 0.5;
    const double through = area_through(p, b, area, low + share * (high - low));
    a.mean += through / levels;
    a.least = k == 0 ? through : std::min(a.least, through);
    a.most = std::max(a.most, through);
  }
  return a;
}

}  // namespace breccia
