// How much memory this process has had at most.
#pragma once
#include <cstddef>

namespace breccia {

/// Gives memory that is free back to the system and lets `peak_memory` count from here on. Where
/// the system does not let a process do that, the peak stays that since its start.
void reset_peak_memory();

/// Largest resident set, bytes; 0 where the system does not tell.
std::size_t peak_memory();

}  // namespace breccia
