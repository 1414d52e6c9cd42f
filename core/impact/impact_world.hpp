// Everything that a run of free particles moves, and the forces of an instant.
#pragma once
#include <vector>

#include "core/geometry/wall_motion.hpp"
#include "core/impact/contacts.hpp"

namespace breccia {

/// The contact that the curve follows: the one that closed first.
struct Followed {
  const ImpactContactTable* table = nullptr;
  Row row = 0, partner = 0;
};

/// How far a plane with a load has come along its normal.
struct Floating {
  double offset = 0, speed = 0;  ///< m, m/s
  double pressed = 0;            ///< N, by the particles in this step
  double demand = 0;             ///< kg, of the step
};

struct ImpactWorld {
  const ImpactScene& scene;
  std::vector<ImpactRecord>& records;  ///< of each particle, row by row
  double dt = 0;                       ///< s
  std::uint64_t step = 0;
  ParticleTable particles{};
  ImpactSearch search{};
  ImpactContactTable pairs{}, walls{};
  std::vector<Wall> placed{}, placed_before{};  ///< the scene's walls at this instant and one step ago
  std::vector<Floating> floating{};             ///< beside the walls
  std::vector<WallLoad> loads{};                ///< by name, of this step; work: since the start
  std::vector<WallLoad> sums{};                 ///< of the steps since the last row
  std::uint64_t summed = 0;                     ///< steps
  std::vector<double> demand{};                 ///< kg, of the step, per particle
  std::vector<char> touched{};                  ///< per particle, in this step
  Followed followed{};
  ImpactRow now{};  ///< of the instant of the last forces

  double time() const { return static_cast<double>(step) * dt; }
};

/// Forces at the positions of this instant.
void find_forces(ImpactWorld& world);

}  // namespace breccia
