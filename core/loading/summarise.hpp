// What a run of a laboratory test came to, taken from its curve and its world.
#pragma once
#include "core/loading/findings.hpp"
#include "core/loading/laboratory_tests.hpp"
#include "core/loading/load_test.hpp"

namespace breccia {

RunSummary summarise(const LaboratoryTest& test, const World& world, const Assembly& assembly,
                     const LoadTest& load, const LoadResult& result);

/// Its word in a summary.
std::string name_of(Stopped stopped);

/// The straight line through the peaks of a series, where the test has one.
void fit_peaks(const LaboratoryTest& test, SeriesSummary& series);

}  // namespace breccia
