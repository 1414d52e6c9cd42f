// Moves overlapping spheres to where their overlaps and gaps are small and evenly shared.
#pragma once
#include <functional>
#include <span>
#include <vector>

#include "core/packing/region.hpp"

namespace breccia::packing {

struct RelaxStage {
  int iterations = 0;   ///< at most
  double cohesion = 0;  ///< pull across a gap over push of an equal overlap; 0 = none
  bool linear = false;  ///< contacts, also with walls, push as k_n times the overlap and never pull
  double balance =
      0;  ///< ends early where the root mean square resultant is this part of the mean contact force
};

/// Relaxes the centres x of spheres of radii r. The same bits for any number of threads.
/// @param progress  called with the fraction of the stage done and the mean overlap over the mean
///                  radius; may be empty
/// @return whether the balance was reached; true, too, where nobody touches anybody
bool relax(const Region& region, const RelaxStage& stage, std::span<const double> r, std::span<Vec3> x,
           const std::function<void(double, double)>& progress);

}  // namespace breccia::packing
