// Random numbers with the same bits everywhere: std:: distributions differ from one library to the
// next, engines do not.
#pragma once
#include <cstdint>
#include <random>

namespace breccia {

using Random = std::mt19937_64;

/// Uniform in [0, 1): the upper 53 bits, as many as a double holds.
inline double uniform01(Random& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

}  // namespace breccia
