#include "core/elastic/touching.hpp"

#include "core/geometry/cell_list.hpp"

namespace breccia {

Touching touching_pairs(const Assembly& a, double young_modulus, double friction, int threads) {
  using Ends = std::pair<Row, Row>;
  std::vector<Ends> bonded(a.bonds.size);
  for (std::size_t k = 0; k < bonded.size(); ++k)
    bonded[k] = std::minmax(a.bonds.row_lo[k], a.bonds.row_hi[k]);
  std::sort(bonded.begin(), bonded.end());
  const ParticleTable& p = a.particles;
  std::vector<Ends> pairs;
  for (const RowPair& near : near_pairs(p.position, p.radius, 0.0, 0.0, threads))
    if (!std::binary_search(bonded.begin(), bonded.end(), Ends{near.a, near.b}))
      pairs.emplace_back(near.a, near.b);
  std::sort(pairs.begin(), pairs.end());
  Touching t;
  t.friction = friction;
  t.contacts.resize(pairs.size(), Features{});
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [i, j] = pairs[k];
    t.contacts.row_lo[k] = i;
    t.contacts.row_hi[k] = j;
    t.contacts.stiffness[k] = contact_stiffness(young_modulus, 1.0, a.space, p.radius[i], p.radius[j]);
  }
  return t;
}

}  // namespace breccia
