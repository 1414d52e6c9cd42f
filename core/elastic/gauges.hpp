// Strain gauges glued to the specimen: strains as fixed linear combinations of displacements.
// docs/model.md, "Laboratory tests".
#pragma once
#include <vector>

#include "core/bonding/assembly.hpp"
#include "core/ranks/partition.hpp"
#include "core/tables/column_storage.hpp"

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

/// Gauges as sums over all rows that the integration takes on its way: a component of the
/// specimen's axis for the axial one, the two across for the lateral one.
struct Watch {
  Column<Vec3> weights;  ///< 1/m, by row; empty: nobody reads
  Vec3 reference;        ///< sum of weights times reference positions
  Vec3 reading;          ///< strains by component, at the end of the last step

  double axial() const { return reading.z; }
  double lateral() const { return reading.x + reading.y; }
};

/// Of an axial gauge, which has weights along z, and a lateral one, which has them across.
Watch watch_of(const Gauge& axial, const Gauge& lateral, std::span<const Vec3> reference,
               const Partition& partition);

}  // namespace breccia
