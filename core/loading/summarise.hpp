// What a run of a laboratory test came to, taken from its curve and its world.
#pragma once
#include "core/loading/findings.hpp"
#include "core/loading/protocol.hpp"

namespace breccia {

/// @param test  name of the program: what a curve means depends on it
RunSummary summarise(const std::string& test, const World& world, const Assembly& assembly,
                     const LoadTest& load, const LoadResult& result);

/// Its word in a summary.
std::string name_of(Stopped stopped);

/// The straight line through the peaks of a series, where the test has one.
void fit_peaks(SeriesSummary& series);

}  // namespace breccia
