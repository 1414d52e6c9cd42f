#include "core/bonding/pieces.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace breccia {
namespace {

/// Sets that grow together.
struct Forest {
  std::vector<std::uint32_t> parent;

  explicit Forest(std::size_t size) : parent(size) { std::iota(parent.begin(), parent.end(), 0u); }

  std::uint32_t root(std::uint32_t k) {
    while (parent[k] != k) k = parent[k] = parent[parent[k]];
    return k;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a), b = root(b);
    if (a != b) parent[std::max(a, b)] = std::min(a, b);
  }
};

std::vector<RowPair> links_of(const BondTable& b) {
  std::vector<RowPair> links(b.size);
  for (std::size_t k = 0; k < b.size; ++k) links[k] = {b.row_lo[k], b.row_hi[k]};
  return links;
}

/// Per piece, whether it has spheres in both bodies that the loading holds; between planes, which
/// hold nothing, whether it is the largest.
std::vector<char> reach_across(const Pieces& pieces, const Assembly& a) {
  if (a.planes) {
    std::vector<char> largest(pieces.sizes.size());
    largest.front() = 1;
    return largest;
  }
  std::vector<char> lower(pieces.sizes.size()), upper(lower), both(lower);
  for (std::size_t row = a.particles.free; row < a.particles.size; ++row)
    (row < a.first_top ? lower : upper)[pieces.of[row]] = 1;
  for (std::size_t k = 0; k < both.size(); ++k) both[k] = lower[k] && (upper[k] || a.grip == Support::vice);
  return both;
}

/// Beyond three times the extent of the middle 90 % of the spheres.
class FarAway {
public:
  explicit FarAway(const Specimen& specimen) {
    for (const auto along : {&Vec3::x, &Vec3::y, &Vec3::z}) {
      std::vector<double> at;
      for (const SpecimenSphere& s : specimen.spheres) at.push_back(s.centre.*along);
      const auto share = [&](std::size_t twentieth) {
        const auto place = at.begin() + static_cast<std::ptrdiff_t>((at.size() - 1) * twentieth / 20);
        std::nth_element(at.begin(), place, at.end());
        return *place;
      };
      const double low = share(1), high = share(19);
      middle_.*along = 0.5 * (low + high);
      extent_ = std::max(extent_, high - low);
    }
    for (const SpecimenSphere& s : specimen.spheres) extent_ = std::max(extent_, 2.0 * s.radius);
  }

  bool operator()(const Vec3& x) const {
    const Vec3 d = x - middle_;
    return std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) > 3.0 * extent_;
  }

private:
  Vec3 middle_;
  double extent_ = 0;
};

bool any_of(const std::vector<char>& flags) {
  return std::find(flags.begin(), flags.end(), 1) != flags.end();
}

}  // namespace

Pieces pieces_of(std::size_t spheres, std::span<const RowPair> links) {
  Forest forest(spheres);
  for (const RowPair& link : links) forest.join(link.a, link.b);
  std::vector<std::size_t> size(spheres);
  for (std::uint32_t k = 0; k < spheres; ++k) ++size[forest.root(k)];
  std::vector<std::uint32_t> roots, number(spheres);
  for (std::uint32_t k = 0; k < spheres; ++k)
    if (size[k] > 0) roots.push_back(k);
  std::stable_sort(roots.begin(), roots.end(), [&](auto a, auto b) { return size[a] > size[b]; });
  Pieces pieces;
  for (std::uint32_t k = 0; k < roots.size(); ++k) {
    number[roots[k]] = k;
    pieces.sizes.push_back(size[roots[k]]);
  }
  pieces.of.resize(spheres);
  for (std::uint32_t k = 0; k < spheres; ++k) pieces.of[k] = number[forest.root(k)];
  return pieces;
}

Connection leave_out_loose(Assembly& a, bool contacts, int threads) {
  std::vector<RowPair> links = links_of(a.bonds);
  const Pieces bonded = pieces_of(a.particles.size, links);
  Connection c;
  for (const std::size_t size : bonded.sizes)
    if (size > 1) c.pieces.push_back(size);
  c.unbonded = bonded.sizes.size() - c.pieces.size();
  std::vector<char> carries = reach_across(bonded, a);
  c.by_bonds = c.joined = any_of(carries);
  Pieces touching = bonded;
  if (contacts && c.pieces.size() > 1) {
    const std::vector<RowPair> touch =
        near_pairs(a.particles.position, a.particles.radius, 0.0, 0.0, threads);
    links.insert(links.end(), touch.begin(), touch.end());
    touching = pieces_of(a.particles.size, links);
    carries = reach_across(touching, a);
    c.joined = any_of(carries);
  }
  a.loose.assign(a.particles.size, 0);
  for (std::size_t row = 0; row < a.particles.size; ++row) {
    const bool alone = bonded.sizes[bonded.of[row]] == 1;
    if (!alone && carries[touching.of[row]]) continue;
    a.loose[row] = 1;
    ++c.loose;
  }
  std::erase_if(a.lateral, [&](Row row) { return a.loose[row] != 0; });
  return c;
}

MainBody main_body(const Specimen& specimen, double range, int threads) {
  const FarAway far_away(specimen);
  std::vector<std::size_t> near;  // a list of cells is of no use where one sphere lies miles away
  std::vector<Vec3> centre;
  std::vector<double> radius;
  for (std::size_t k = 0; k < specimen.spheres.size(); ++k) {
    const SpecimenSphere& s = specimen.spheres[k];
    if (far_away(s.centre)) continue;
    near.push_back(k), centre.push_back(s.centre), radius.push_back(s.radius);
  }
  const Pieces pieces = pieces_of(near.size(), near_pairs(centre, radius, range, 0.0, threads));
  const auto is_large = [&](std::size_t size) { return 10 * size >= pieces.sizes.front(); };
  MainBody body{std::vector<char>(specimen.spheres.size()), 0};
  for (std::size_t k = 0; k < near.size(); ++k) body.has[near[k]] = is_large(pieces.sizes[pieces.of[k]]);
  for (const std::size_t size : pieces.sizes) body.pieces += is_large(size);
  return body;
}

}  // namespace breccia
