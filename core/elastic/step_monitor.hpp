// What is known about the step in use, from look to look.
#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "kernels/loops/bond_pass.hpp"

namespace breccia {

/// What is known about the step in use.
struct StepMonitor {
  double margin = 0;                         ///< of the stability number below 1, at the last look
  std::vector<std::pair<Gid, Gid>> counted;  ///< contacts that were in it, rising
  std::uint64_t looks = 0;                   ///< estimates of all of it after the first
  std::uint64_t local_looks = 0;             ///< around new contacts alone
  double first_dt = 0;                       ///< s, what the run began with
};

}  // namespace breccia
