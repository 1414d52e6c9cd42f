// The part of the material that a bond stands for: its area. docs/model.md, "Bonds".
#pragma once
#include <span>
#include <vector>

#include "core/base/scene_options.hpp"
#include "core/geometry/specimen.hpp"
#include "core/tables/bond_table.hpp"
#include "core/tables/particle_table.hpp"

namespace breccia {

/// Areas of all bonds with alpha = 1, m^2; plane: lengths times 1 m. Made from the positions that
/// bonds were made at. minimum: pi r_c^2 or 2 r_c with r_c = min(r_i, r_j) (P21); harmonic: r_c = 2
/// r_i r_j/(r_i + r_j) (S4.31); cone: pi r_i r_j (S4.28); polyhedron: that, corrected so that the
/// areas of a particle add up to the surface of a regular polyhedron around it (S4.30) (S4.32);
/// voronoi: the face between the radical Voronoi cells, 0 for a pair without one (B10).
/// @param lateral  rows at the lateral surface, for polyhedron
/// @param axis  of the body, for voronoi: 'z', or 'y' for a cylinder or disc that lies
/// @throws BadInput: a row that is not there, a radius not above zero; voronoi: as voronoi_cells
std::vector<double> bond_areas(AreaRule rule, const ParticleTable& particles, const BondTable& bonds,
                               std::span<const Row> lateral, const Body& body, Space space, int threads,
                               char axis = 'z');

}  // namespace breccia
