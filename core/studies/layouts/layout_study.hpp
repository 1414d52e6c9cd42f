// The study: all layouts of a packed cylinder, timed in turn and held against production's pass.
#pragma once
#include <functional>
#include <vector>

#include "core/base/median_and_range.hpp"
#include "core/studies/layouts/byte_count.hpp"
#include "core/studies/layouts/layout_run.hpp"
#include "core/studies/layouts/operation_count.hpp"
#include "core/studies/layouts/roofline.hpp"

namespace breccia {

/// Beyond this a layout does not compute the same as production in doubles.
constexpr double allowed_difference(Precision precision) {
  return precision == Precision::single ? 1e-4 : 1e-9;
}

/// Of both precisions.
template <class T>
struct Both {
  T single, full;
  const T& of(Precision precision) const { return precision == Precision::single ? single : full; }
};

struct LayoutScene {
  World world;            ///< in doubles
  Both<ByteCount> bytes;  ///< per bond
};

/// A concrete cylinder, 150 x 300 mm, a few steps into its compression; bonds are intact.
/// @param progress  called with the fraction of the packing that is done
LayoutScene make_layout_scene(std::size_t spheres, const Material& material, int threads,
                              const std::function<void(double)>& progress);

struct LayoutTiming {
  int repeat = 5;              ///< blocks of passes
  double block_seconds = 0.1;  ///< of a block, about
};

struct LayoutResult {
  Layout layout;
  std::size_t colours = 0;       ///< of coloured bonds, else 0
  double difference = 0;         ///< from production in doubles, see largest_difference
  std::size_t passes = 0;        ///< in a block
  std::vector<double> block_ns;  ///< ns per bond and pass, of each block
  MachinePeak peak;
  PassLimit limit;

  MedianAndRange spread() const { return median_and_range_of(block_ns); }  ///< ns per bond
  double median() const { return spread().median; }
  double bonds_per_second() const { return 1e9 / median(); }
  double fraction_of_limit() const { return 1e9 * limit.time() / median(); }
};

/// Every layout in turn, block after block, so that what else happens on the machine meets all of
/// them.
std::vector<LayoutResult> study_layouts(const LayoutScene& scene, int threads, const LayoutTiming& timing);

}  // namespace breccia
