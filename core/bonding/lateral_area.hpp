// The part of the lateral surface that each particle at it stands for: weights of the confining
// pressure.
#pragma once
#include <span>
#include <vector>

#include "core/base/scene_options.hpp"
#include "core/geometry/specimen.hpp"
#include "core/tables/particle_table.hpp"

namespace breccia {

/// Areas of the nominal lateral surface nearest (in the radical Voronoi sense) to each of its
/// particles, in their order, m^2; plane: lengths times 1 m. They add up to the whole of it: only
/// its particles share it, so what one behind them sees through a gap goes to those around the gap.
/// 0 for one that touches none. Made from the positions that bonds were made at.
/// @param axis  of the body: 'z', or 'y' for a cylinder or disc that lies
/// @throws BadInput: no such rows, a row that is not there, a radius not above zero, a body without
///         volume
std::vector<double> lateral_areas(const ParticleTable& particles, std::span<const Row> lateral,
                                  const Body& body, Space space = Space::three_d, int threads = 1,
                                  char axis = 'z');

}  // namespace breccia
