#include "core/bonding/lateral_area.hpp"

#include "core/base/error.hpp"
#include "core/geometry/body_walls.hpp"
#include "core/geometry/voronoi_cells.hpp"

namespace breccia {

std::vector<double> lateral_areas(const ParticleTable& particles, std::span<const Row> lateral,
                                  const Body& body, Space space, int threads, char axis) {
  std::vector<Vec3> position;
  std::vector<double> radius;
  for (const Row row : lateral) {
    if (row >= particles.size) fail<BadInput>("lateral: row {} of {} particles", row, particles.size);
    position.push_back(particles.reference_position[row]);
    radius.push_back(particles.radius[row]);
  }
  if (lateral.empty())
    fail<BadInput>(
        "specimen: no particle at the lateral surface to share it; check specimen.diameter and "
        "specimen.centre");
  const VoronoiCells cells = voronoi_cells(position, radius, body, space, threads, axis);
  std::vector<double> area(lateral.size());
  double sum = 0.0;
  for (const WallFace& f : cells.wall_faces)
    if (f.lateral) area[f.row] += f.area, sum += f.area;
  // from the prism that stands for a round lateral surface (or one moved out) to the nominal one: 1
  // + 1e-5
  const double to_nominal = lateral_of(body, space, axis) / sum;
  for (double& a : area) a *= to_nominal;
  return area;
}

}  // namespace breccia
