#include "core/packing/neighbours.hpp"

#include <algorithm>

#include "core/base/threads.hpp"

namespace breccia::packing {
namespace {

using Row = std::uint32_t;

struct Grid {
  Vec3 edge;  // m
  int nx, ny, nz;

  Grid(const Region& region, double side)
      : edge(extent(region)),
        nx(cells(edge.x, side)),
        ny(region.plane() ? 1 : cells(edge.y, side)),
        nz(cells(edge.z, side)) {}
  static int cells(double length, double side) {
    return std::clamp(static_cast<int>(length / side), 1, 1000);
  }
  static int index(double c, double length, int n) {
    return std::clamp(static_cast<int>((c / length + 0.5) * n), 0, n - 1);
  }
  int ix(double c) const { return index(c, edge.x, nx); }
  int iy(double c) const { return index(c, edge.y, ny); }
  int iz(double c) const { return index(c, edge.z, nz); }
  std::size_t cell(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(ny) + static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(nx) +
           static_cast<std::size_t>(i);
  }
  std::size_t cell(const Vec3& x) const { return cell(ix(x.x), iy(x.y), iz(x.z)); }
  std::size_t size() const { return cell(0, 0, nz); }
};

struct Sorted {
  std::vector<Row> start, rows;  // rows of cell c: rows[start[c]] to rows[start[c + 1] - 1], rising
};

Sorted sort_into(const Grid& grid, std::span<const Vec3> x) {
  Sorted s{std::vector<Row>(grid.size() + 1), std::vector<Row>(x.size())};
  for (const Vec3& p : x) ++s.start[grid.cell(p) + 1];
  for (std::size_t c = 0; c < grid.size(); ++c) s.start[c + 1] += s.start[c];
  std::vector<Row> next(s.start.begin(), s.start.end() - 1);
  for (Row i = 0; i < x.size(); ++i) s.rows[next[grid.cell(x[i])]++] = i;
  return s;
}

}  // namespace

std::vector<std::uint32_t> spatial_order(const Region& region, std::span<const Vec3> x, double side) {
  return sort_into(Grid(region, side), x).rows;
}

Neighbours find_neighbours(const Region& region, std::span<const Vec3> x, std::span<const double> r,
                           double reach, double skin) {
  const std::size_t n = x.size();
  const Grid grid(region, spacing(region, n));
  const Sorted sorted = sort_into(grid, x);

  // Fixed blocks of rows: what a block finds does not depend on the thread that it falls to.
  constexpr std::size_t block = 512;
  std::vector<std::vector<Row>> found((n + block - 1) / block);
  std::vector<Row> finds(n);
  for_tasks(found.size(), [&](std::size_t b) {
    for (std::size_t i = b * block; i < std::min(n, (b + 1) * block); ++i) {
      const std::size_t before = found[b].size();
      const Vec3 p = x[i];
      const double far = 2 * reach * r[i] + skin;
      const int x0 = grid.ix(p.x - far), x1 = grid.ix(p.x + far);
      const int y0 = grid.iy(p.y - far), y1 = grid.iy(p.y + far);
      const int z0 = grid.iz(p.z - far), z1 = grid.iz(p.z + far);
      for (int c = z0; c <= z1; ++c)
        for (int a = y0; a <= y1; ++a)
          for (Row k = sorted.start[grid.cell(x0, a, c)]; k < sorted.start[grid.cell(x1, a, c) + 1]; ++k) {
            const Row j = sorted.rows[k];
            if (r[j] > r[i] || (r[j] == r[i] && j <= i)) continue;
            const Vec3 d = x[j] - p;
            const double limit = reach * (r[i] + r[j]) + skin;
            if (dot(d, d) < limit * limit) found[b].push_back(j);
          }
      finds[i] = static_cast<Row>(found[b].size() - before);
    }
  });

  Neighbours list{std::vector<Row>(n + 1), {}};
  for (std::size_t i = 0; i < n; ++i) list.first[i + 1] += finds[i];
  for (const auto& rows : found)
    for (const Row j : rows) ++list.first[j + 1];
  for (std::size_t i = 0; i < n; ++i) list.first[i + 1] += list.first[i];
  list.other.resize(list.first[n]);
  std::vector<Row> next(list.first.begin(), list.first.end() - 1);
  for (std::size_t i = 0, k = 0; i < n; ++i, k = i % block ? k : 0)
    for (const std::size_t end = k + finds[i]; k < end; ++k) {
      const Row j = found[i / block][k];
      list.other[next[i]++] = j;
      list.other[next[j]++] = static_cast<Row>(i);
    }
  return list;
}

}  // namespace breccia::packing
