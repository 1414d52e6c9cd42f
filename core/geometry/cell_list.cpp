#include "core/geometry/cell_list.hpp"

#include <algorithm>
#include <array>

#include "core/base/threads.hpp"

namespace breccia {
namespace {

/// Rows sorted by cell: cell c holds rows order[first[c]] ... order[first[c + 1] - 1], with a copy
/// of what the distance test reads, in that order.
struct Cells {
  std::array<std::int64_t, 3> count{};
  std::vector<std::uint32_t> first;
  std::vector<Row> order;
  std::vector<Vec3> position;
  std::vector<double> radius;
};

Cells sort_into_cells(Strided<const Vec3> position, std::span<const double> radius, double side) {
  Vec3 low = position[0], high = position[0];
  for (const Vec3& p : position) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const auto cells_along = [&](double extent) {
    return static_cast<std::int64_t>(std::clamp(extent / side, 1.0, 1e5));
  };
  Cells cells;
  do {  // fragments may fly far: no more cells than a few per particle, whatever the extent
    cells.count = {cells_along(high.x - low.x), cells_along(high.y - low.y), cells_along(high.z - low.z)};
    side *= 1.3;
  } while (cells.count[0] * cells.count[1] * cells.count[2] >
           8 * static_cast<std::int64_t>(position.size()) + 64);
  const auto index = [](double at, double from, double to, std::int64_t n) {
    if (!(to > from)) return std::int64_t{0};
    return std::clamp<std::int64_t>(
        static_cast<std::int64_t>((at - from) / (to - from) * static_cast<double>(n)), 0, n - 1);
  };
  std::vector<std::uint32_t> cell(position.size());
  cells.first.assign(static_cast<std::size_t>(cells.count[0] * cells.count[1] * cells.count[2]) + 1, 0);
  for (std::size_t row = 0; row < position.size(); ++row) {
    const Vec3& p = position[row];
    const auto c = (index(p.z, low.z, high.z, cells.count[2]) * cells.count[1] +
                    index(p.y, low.y, high.y, cells.count[1])) *
                       cells.count[0] +
                   index(p.x, low.x, high.x, cells.count[0]);
    cell[row] = static_cast<std::uint32_t>(c);
    ++cells.first[static_cast<std::size_t>(c) + 1];
  }
  for (std::size_t c = 1; c < cells.first.size(); ++c) cells.first[c] += cells.first[c - 1];
  cells.order.resize(position.size());
  cells.position.resize(position.size());
  cells.radius.resize(position.size());
  std::vector<std::uint32_t> next(cells.first.begin(), cells.first.end() - 1);
  for (std::size_t row = 0; row < position.size(); ++row) {
    const std::uint32_t at = next[cell[row]]++;
    cells.order[at] = static_cast<Row>(row);
    cells.position[at] = position[row];
    cells.radius[at] = radius[row];
  }
  return cells;
}

}  // namespace

std::vector<RowPair> near_pairs(Strided<const Vec3> position, std::span<const double> radius, double relative,
                                double absolute, int threads) {
  if (position.empty()) return {};
  const double largest = *std::max_element(radius.begin(), radius.end());
  const double reach = (1.0 + relative) * 2.0 * largest + absolute;
  const Cells cells = sort_into_cells(position, radius, std::max(reach, 1e-300));
  const auto [nx, ny, nz] = cells.count;

  // the rows before this one in its own cell, and the half of the neighbouring cells that come
  // before: each pair once
  std::vector<std::vector<RowPair>> found(static_cast<std::size_t>(std::max(threads, 1)));
  const int ranges = position.size() < 512 ? 1 : std::max(threads, 1);
  const auto layers = static_cast<std::size_t>(ny * nz);
  for_ranges(ranges, [&](int range) {
    auto& pairs = found[static_cast<std::size_t>(range)];
    const auto test = [&](std::uint32_t i, std::uint32_t from, std::uint32_t to) {
      const Vec3 x = cells.position[i];
      const double r = cells.radius[i];
      for (std::uint32_t j = from; j < to; ++j) {
        const Vec3 d = cells.position[j] - x;
        const double near = (1.0 + relative) * (r + cells.radius[j]) + absolute;
        if (near > 0.0 && dot(d, d) <= near * near) {
          const auto [a, b] = std::minmax(cells.order[i], cells.order[j]);
          pairs.push_back({a, b});
        }
      }
    };
    for (std::size_t layer = range_first(layers, range, ranges);
         layer < range_first(layers, range + 1, ranges); ++layer) {
      const auto cy = static_cast<std::int64_t>(layer) % ny, cz = static_cast<std::int64_t>(layer) / ny;
      for (std::int64_t cx = 0; cx < nx; ++cx) {
        const auto c = static_cast<std::size_t>((cz * ny + cy) * nx + cx);
        for (std::uint32_t i = cells.first[c]; i < cells.first[c + 1]; ++i) {
          // cells of a row along x are neighbours in memory: one run of spheres for each of the
          // rows before
          const std::int64_t left = std::max<std::int64_t>(cx - 1, 0),
                             right = std::min<std::int64_t>(cx + 1, nx - 1);
          for (std::int64_t dz = -1; dz <= 0; ++dz)
            for (std::int64_t dy = -1; dy <= (dz < 0 ? 1 : -1); ++dy) {
              const std::int64_t y = cy + dy, z = cz + dz;
              if (y < 0 || y >= ny || z < 0) continue;
              const auto row = static_cast<std::size_t>((z * ny + y) * nx);
              test(i, cells.first[row + static_cast<std::size_t>(left)],
                   cells.first[row + static_cast<std::size_t>(right) + 1]);
            }
          if (cx > 0) test(i, cells.first[c - 1], cells.first[c]);
          test(i, cells.first[c], i);
        }
      }
    }
  });
  std::vector<RowPair> pairs = std::move(found[0]);
  for (std::size_t k = 1; k < found.size(); ++k) pairs.insert(pairs.end(), found[k].begin(), found[k].end());
  return pairs;
}

}  // namespace breccia
