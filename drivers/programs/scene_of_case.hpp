// What a case says, as the solver takes it.
#pragma once
#include "core/loading/laboratory_tests.hpp"
#include "core/world/options.hpp"
#include "io/cases/case.hpp"

namespace breccia {

/// Of run number `run`, one for each confinement.
LoadTest load_test(const Case& c, const LaboratoryTest& test, std::size_t run);

/// @param asked  features of the scene
WorldOptions world_options(const Case& c, const LaboratoryTest& test, const Features& asked, int threads);

}  // namespace breccia
