// A plane behind each end layer, so that no sphere slips through it: rough or smooth, a layer of
// spheres has gaps, and under hundreds of MPa a loose sphere finds them. And planes as the strips
// that press a disc. docs/model.md, "What is held".
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "core/boundary/platens_and_confinement.hpp"

namespace breccia {

/// Two frictionless planes that move with the platens. They touch free spheres only, and none of a
/// specimen at rest: each stands at the outermost point of the specimen.
struct EndWalls {
  bool enabled = false;
  std::array<double, 2> place{};  ///< m, of the planes along z when the run began
  double half_width = 0;          ///< m, along x, of a strip; 0: no end
  double stiffness = 0;           ///< Pa: force over radius and depth
  std::vector<Row> rows;          ///< free spheres that may touch before the list is made anew, rising
  std::vector<double> force;      ///< N, along z, of this step, beside them
  std::array<double, 2> push{};   ///< N, along z, of each plane on the spheres in this step
  std::uint64_t next_list = 0;    ///< step at which the list is made anew
};

/// @param young_modulus  Pa, of the bonds
EndWalls make_end_walls(const Assembly& assembly, double young_modulus, double alpha);

/// Adds the planes' forces (B111). Called on every rank.
/// @param platens  whose travel the planes follow
void push_back(EndWalls& walls, const Platens& platens, ParticleTable& particles, const Partition& partition,
               std::uint64_t step, double dt, int threads);

}  // namespace breccia
