// Order of particles along a space-filling curve: neighbours in space lie near each other in
// memory.
#pragma once
#include <span>
#include <vector>

#include "core/tables/column.hpp"

namespace breccia {

/// Index on a Hilbert curve of 2^21 cells a side over the box around the points.
/// J. Skilling, "Programming the Hilbert curve", AIP Conf. Proc. 707 (2004) 381.
std::vector<std::uint64_t> hilbert_keys(std::span<const Vec3> points);

}  // namespace breccia
