// The space of a body shared out among its particles: radical Voronoi cells (a point belongs to the
// particle with the smallest |x - x_i|^2 - r_i^2), cut by the walls of the nominal body.
#pragma once
#include <span>
#include <vector>

#include "core/base/scene_options.hpp"
#include "core/geometry/specimen.hpp"
#include "core/tables/column.hpp"

namespace breccia {

struct VoronoiFace {
  Row a, b;     ///< particles on either side, a < b
  double area;  ///< m^2
};

struct WallFace {
  Row row;
  double area;      ///< m^2
  double distance;  ///< m, of the particle's centre from the wall
  bool lateral;     ///< false: a flat end
};

struct VoronoiCells {
  std::vector<VoronoiFace> faces;    ///< each pair once, rising (a, b)
  std::vector<WallFace> wall_faces;  ///< rising rows; several of one wall where it is round
  std::vector<double> volume;        ///< m^3; 0 where neighbours leave a particle nothing
  double grown = 0;  ///< m, by which a wall was moved out to hold a centre that lies outside; 0 as a rule
};

/// Cells of all particles, which fill the body without gap or overlap: sum of volumes = nominal
/// volume. A round lateral surface is a prism of 360 sides with the section of the circle: flat
/// walls are the same for all cells, so that both ends of a pair see one face. Spheres that stick
/// out of a wall are cut by it; a wall that a centre lies outside of is moved out to that centre.
/// plane: cells of discs in the x-z plane; areas are lengths times 1 m, volumes areas times 1 m.
/// @param body  middle at the origin
/// @param axis  'z', or 'y' for a cylinder or disc that lies
/// @throws BadInput: sizes or positions that make no body, two particles with one centre
VoronoiCells voronoi_cells(std::span<const Vec3> position, std::span<const double> radius, const Body& body,
                           Space space, int threads, char axis = 'z');

}  // namespace breccia
