#include "core/geometry/voronoi_cells.hpp"

#include <voro++/container.hh>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "core/base/error.hpp"
#include "core/base/threads.hpp"
#include "core/geometry/body_walls.hpp"

namespace breccia {
namespace {

/// Faces below this fraction of the mean radius squared are round-off of voro++ (its tolerance is
/// 1e-11), not faces: cells of lattices meet in edges and points.
constexpr double no_face = 1e-9;

/// Particles and walls in units of the mean radius: the tolerances of voro++ are absolute.
struct Scaled {
  double unit = 1;  ///< m
  std::vector<Vec3> x;
  std::vector<double> r;
  std::vector<WallPlane> walls;
  Vec3 low, high;  ///< a box around all walls
};

constexpr double half_slab = 1.0;  ///< mean radii: half the thickness that stands for a plane

void check_particles(std::span<const Vec3> position, std::span<const double> radius, Space space) {
  for (std::size_t k = 0; k < position.size(); ++k) {
    const Vec3& x = position[k];
    if (!std::isfinite(x.x + x.y + x.z) || !std::isfinite(radius[k]) || !(radius[k] > 0.0))
      fail<BadInput>("specimen: particle in row {} at ({}, {}, {}) m with a radius of {} m has no cell", k,
                     x.x, x.y, x.z, radius[k]);
    if (space == Space::two_d && x.y != 0.0)
      fail<BadInput>("specimen: disc in row {} lies {} m out of the plane y = 0", k, x.y);
  }
  std::vector<Vec3> sorted(position.begin(), position.end());
  const auto key = [](const Vec3& p) { return std::tie(p.x, p.y, p.z); };
  std::sort(sorted.begin(), sorted.end(), [&](const Vec3& p, const Vec3& q) { return key(p) < key(q); });
  const auto twin = std::adjacent_find(sorted.begin(), sorted.end());
  if (twin != sorted.end())
    fail<BadInput>("specimen: two particles have their centre at ({}, {}, {}) m; remove one of them", twin->x,
                   twin->y, twin->z);
}

Scaled scaled(std::span<const Vec3> position, std::span<const double> radius,
              const std::vector<WallPlane>& walls, Space space) {
  Scaled s;
  s.unit = std::accumulate(radius.begin(), radius.end(), 0.0) / static_cast<double>(radius.size());
  const double per_unit = 1.0 / s.unit;
  for (const Vec3& p : position) s.x.push_back(per_unit * p);
  for (const double r : radius) s.r.push_back(per_unit * r);
  for (const WallPlane& w : walls) {
    s.walls.push_back({w.normal, per_unit * w.distance, w.lateral});
    // a prism reaches beyond its own sides by 4e-5 of their distance
    const double reach = 1.0 + 1.001 * per_unit * w.distance;
    const Vec3 far = reach * w.normal;
    s.low = {std::min(s.low.x, far.x), std::min(s.low.y, far.y), std::min(s.low.z, far.z)};
    s.high = {std::max(s.high.x, far.x), std::max(s.high.y, far.y), std::max(s.high.z, far.z)};
  }
  if (space == Space::two_d) s.low.y = -half_slab, s.high.y = half_slab;
  return s;
}

/// Blocks of voro++'s grid along an edge, for 5.6 particles a block: its fastest.
int blocks_along(const Scaled& s, double edge) {
  const Vec3 box = s.high - s.low;
  return static_cast<int>(edge * std::cbrt(static_cast<double>(s.x.size()) / (5.6 * box.x * box.y * box.z))) +
         1;
}

/// What one thread needs: a container of voro++ keeps working storage and cannot be shared.
struct Container {
  voro::container_poly box;
  voro::particle_order place;  ///< where in the box the particle of each row is

  explicit Container(const Scaled& s)
      : box(s.low.x, s.high.x, s.low.y, s.high.y, s.low.z, s.high.z, blocks_along(s, s.high.x - s.low.x),
            blocks_along(s, s.high.y - s.low.y), blocks_along(s, s.high.z - s.low.z), false, false, false, 8),
        place(static_cast<int>(s.x.size())) {
    for (std::size_t k = 0; k < s.x.size(); ++k)
      box.put(place, static_cast<int>(k), s.x[k].x, s.x[k].y, s.x[k].z, s.r[k]);
  }
  Container(const Container&) = delete;  // voro++ would share its storage between copies
  Container& operator=(const Container&) = delete;
};

constexpr int first_wall_id = -7;  ///< voro++ counts the sides of its box from -1 to -6

/// Cuts a cell by the walls that it reaches; false: nothing is left.
bool cut_by_walls(voro::voronoicell_neighbor& cell, const Vec3& centre, const std::vector<WallPlane>& walls,
                  std::vector<double>& vertices) {
  cell.vertices(vertices);  // relative to the centre
  double reach2 = 0.0;
  for (std::size_t k = 0; k < vertices.size(); k += 3) {
    const Vec3 v{vertices[k], vertices[k + 1], vertices[k + 2]};
    reach2 = std::max(reach2, dot(v, v));
  }
  int id = first_wall_id;
  for (const WallPlane& w : walls) {
    const double distance = w.distance - dot(w.normal, centre);
    const bool reached = distance <= 0.0 || distance * distance <= reach2;
    if (reached && !cell.nplane(w.normal.x, w.normal.y, w.normal.z, 2.0 * distance, id)) return false;
    --id;
  }
  return true;
}

/// The cells of rows [first, last), faces only where this row is the lower of the two.
VoronoiCells cells_of_rows(const Scaled& s, Space space, std::size_t first, std::size_t last) {
  VoronoiCells out;
  if (first == last) return out;
  // of a slab to 1 m of plane: areas are lengths times 1 m
  const bool flat = space == Space::two_d;
  const double to_area = flat ? s.unit / (2.0 * half_slab) : s.unit * s.unit;
  const double to_volume = to_area * s.unit;
  Container c(s);
  voro::voronoicell_neighbor cell;
  std::vector<int> behind;
  std::vector<double> area, vertices;
  for (std::size_t row = first; row < last; ++row) {
    const bool left = c.box.compute_cell(cell, c.place.o[2 * row], c.place.o[2 * row + 1]) &&
                      cut_by_walls(cell, s.x[row], s.walls, vertices);
    out.volume.push_back(left ? to_volume * cell.volume() : 0.0);
    if (!left) continue;
    cell.neighbors(behind);
    cell.face_areas(area);
    const std::size_t begin = out.faces.size();
    const Row here = static_cast<Row>(row);
    for (std::size_t k = 0; k < behind.size(); ++k) {
      if (area[k] < no_face) continue;
      if (behind[k] <= first_wall_id) {
        const WallPlane& w = s.walls[static_cast<std::size_t>(first_wall_id - behind[k])];
        const double distance = s.unit * (w.distance - dot(w.normal, s.x[row]));
        out.wall_faces.push_back({here, to_area * area[k], distance, w.lateral});
      } else if (behind[k] > static_cast<int>(row)) {
        out.faces.push_back({here, static_cast<Row>(behind[k]), to_area * area[k]});
      }
    }
    std::sort(out.faces.begin() + static_cast<std::ptrdiff_t>(begin), out.faces.end(),
              [](const VoronoiFace& p, const VoronoiFace& q) { return p.b < q.b; });
  }
  return out;
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& part) {
  to.insert(to.end(), part.begin(), part.end());
}

}  // namespace

VoronoiCells voronoi_cells(std::span<const Vec3> position, std::span<const double> radius, const Body& body,
                           Space space, int threads, char axis) {
  check_particles(position, radius, space);
  const BodyWalls walls = walls_of(body, space, axis, position);
  VoronoiCells cells;
  cells.grown = walls.grown;
  if (position.empty()) return cells;
  const Scaled s = scaled(position, radius, walls.planes, space);
  const int ranges = std::max(threads, 1);
  std::vector<VoronoiCells> parts(static_cast<std::size_t>(ranges));
  for_ranges(ranges, [&](int k) {
    parts[static_cast<std::size_t>(k)] = cells_of_rows(s, space, range_first(position.size(), k, ranges),
                                                       range_first(position.size(), k + 1, ranges));
  });
  for (const VoronoiCells& part : parts) {
    append(cells.faces, part.faces);
    append(cells.wall_faces, part.wall_faces);
    append(cells.volume, part.volume);
  }
  return cells;
}

}  // namespace breccia
