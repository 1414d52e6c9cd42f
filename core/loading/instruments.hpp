// What reads a test: gauges on the specimen and the platens, from where everything stood when
// loading began.
#pragma once
#include "core/elastic/gauges.hpp"
#include "core/loading/plan.hpp"
#include "core/loading/recorder.hpp"
#include "core/world/world.hpp"

namespace breccia {

struct Instruments {
  Gauge axial, lateral;
  Datum zeros;
  double free_length = 0;  ///< m, between the held layers
  double sign = 1;         ///< -1: tension counts positive
  int lateral_directions = 2;
  Loading loading = Loading::compression;
  Support grip = Support::ends;
};

/// @param left_out  of the lateral gauge: what has come loose
/// @param zeros  where everything stood; nothing: it stands there now
Instruments make_instruments(const World& world, const Assembly& assembly, const LoadTest& test,
                             std::span<const Gid> left_out = {}, const Datum* zeros = nullptr);

/// One reading after a step. (B91)
StepReading read(World& world, const Instruments& instruments);

/// Platen travel of the loading direction since the start, m.
double travel(const World& world, const Instruments& instruments);

}  // namespace breccia
