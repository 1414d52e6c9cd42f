// Run times of uniaxial compression tests that the authors of the Dempack law have published.
#pragma once
#include <array>
#include <span>
#include <string_view>

namespace breccia {

struct PublishedTimes {
  std::string_view code, parallel;  ///< "Dempack", "MPI"
  std::string_view source, machine;
  std::string_view note;  ///< what is odd in the print; empty: nothing
  std::size_t spheres = 0, steps = 0;
  std::array<int, 6> cores{};
  std::array<double, 6> seconds{};  ///< as printed
};

std::span<const PublishedTimes> published_times();

}  // namespace breccia
