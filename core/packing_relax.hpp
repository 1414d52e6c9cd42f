// Moves overlapping spheres to where their overlaps and gaps are small and evenly shared.
#pragma once
#include <functional>
#include <span>
#include <vector>

#include "core/packing_body.hpp"

namespace breccia::packing {

struct RelaxStage {
  int iterations = 0;
  double cohesion = 0;  ///< pull across a gap over push of an equal overlap; 0 = none
};

/// Relaxes the centres x of spheres of radii r. The same bits for any number of threads.
/// @param progress  called with the fraction of the stage done and the mean overlap over the mean radius; may
/// be empty
void relax(const Body& body, const RelaxStage& stage, std::span<const double> r, std::span<Vec3> x,
           const std::function<void(double, double)>& progress);

}  // namespace breccia::packing
