// How long something takes.
#pragma once
#include <chrono>

namespace breccia {

/// s
template <class Work>
double wall_time(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace breccia
