// One bond along a prescribed path, as the production loop runs it: one number at a time, and in
// wide registers whose lanes carry different bonds.
#pragma once
#include <experimental/simd>
#include <vector>

#include "kernels/laws/bond_force.hpp"
#include "tests/reference/reference.hpp"

namespace breccia::scene {

/// Stretches and tangential displacements, m, from {0, 0, 0} on.
using Path = std::vector<reference::PathPoint>;

template <class R>
constexpr std::size_t lanes() {
  if constexpr (std::is_same_v<R, double>)
    return 1;
  else
    return R::size();
}
template <class R, class Of>
R spread(const Of& of) {
  if constexpr (std::is_same_v<R, double>)
    return of(std::size_t{0});
  else
    return R([&](auto k) { return of(std::size_t{k}); });
}
template <class R>
double lane(const R& r, std::size_t k) {
  if constexpr (std::is_same_v<R, double>)
    return r;
  else
    return r[k];
}
template <class R>
Vec3 lane(const Vec<R>& r, std::size_t k) {
  return {lane(r.x, k), lane(r.y, k), lane(r.z, k)};
}

/// Force on lo and history after a point of a path along x.
struct Outcome {
  Vec3 force;  ///< x: tension positive
  BondHistory<double> history;
};

/// Bonds along their paths, as many at once as R has lanes; a path that is shorter than others
/// stands still at its end.
template <Features features, class R, class Law>
std::vector<std::vector<Outcome>> follow(const Law& law, const std::vector<BondConstants<double>>& bonds,
                                         const std::vector<Path>& paths) {
  using reference::PathPoint;
  std::vector<std::vector<Outcome>> out(bonds.size());
  for (std::size_t first = 0; first < bonds.size(); first += lanes<R>()) {
    const auto item = [&](std::size_t k) { return (first + k) % bonds.size(); };
    const auto constant = [&](double BondConstants<double>::*member) {
      return spread<R>([&](std::size_t k) { return bonds[item(k)].*member; });
    };
    using One = BondConstants<double>;
    const BondConstants<R> c{constant(&One::rest_length), constant(&One::area), constant(&One::strength_area),
                             constant(&One::stiffness), constant(&One::damping)};
    BondHistory<R> h{};
    std::size_t longest = 0;
    for (std::size_t k = 0; k < lanes<R>(); ++k) longest = std::max(longest, paths[item(k)].size());
    for (std::size_t step = 0; step < longest; ++step) {
      const auto now = [&](std::size_t k) {
        return paths[item(k)][std::min(step, paths[item(k)].size() - 1)];
      };
      const auto before = [&](std::size_t k) {
        return step == 0 ? PathPoint{} : paths[item(k)][std::min(step - 1, paths[item(k)].size() - 1)];
      };
      Pair<R> pair{};
      pair.distance = spread<R>([&](std::size_t k) { return bonds[item(k)].rest_length + now(k).u; });
      pair.normal = pair.normal_before = {R(1.0), R(0.0), R(0.0)};
      pair.rate = R(0.0);
      pair.stretching = spread<R>([&](std::size_t k) { return now(k).u - before(k).u; });
      pair.turn_cosine = R(1.0);
      pair.twist = R(0.0);
      pair.slip = {R(0.0), spread<R>([&](std::size_t k) { return now(k).y - before(k).y; }),
                   spread<R>([&](std::size_t k) { return now(k).z - before(k).z; })};
      const Vec<R> force = bond_force<features>(law, c, pair, h);
      for (std::size_t k = 0; k < lanes<R>() && first + k < bonds.size(); ++k)
        if (step < paths[first + k].size())
          out[first + k].push_back({lane(force, k),
                                    {lane(h.shear, k), lane(h.plastic_stretch, k), lane(h.damage_normal, k),
                                     lane(h.damage_shear, k)}});
    }
  }
  return out;
}

}  // namespace breccia::scene
