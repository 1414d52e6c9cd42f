// Strain gauges glued to the specimen: strains as fixed linear combinations of displacements.
// docs/model.md, "Laboratory tests".
#pragma once
#include <vector>

#include "core/bonding/assembly.hpp"
#include "core/ranks/partition.hpp"

namespace breccia {

/// A strain is the sum of weight . displacement over rows, 1/m times m. Positive in compression.
struct Gauge {
  std::vector<Row> rows;
  std::vector<Vec3> weights;  ///< 1/m
};

/// Least-squares slope of u_z over z0 in the middle half, of what hangs together with the ends. No
/// rows where fewer than two heights lie there. (B76)
Gauge axial_gauge(const Assembly& assembly, std::span<const Gid> left_out = {});

/// Least-squares widening across the axis: of the lateral surface at mid-height (middle 40 %); of a
/// disc on edge that of all particles there, along x. No rows where nothing lies there. (B78)
/// @param left_out  ids that have no say
Gauge lateral_gauge(const Assembly& assembly, std::span<const Gid> left_out = {});

/// Strain of the gauge between reference and present positions.
double read_gauge(const Gauge& gauge, Strided<const Vec3> position, std::span<const Vec3> reference,
                  const Partition& partition, int threads = 1);

}  // namespace breccia
