// From a case to a bonded specimen: read or packed, put in place, checked, bonded.
#pragma once
#include "core/assembly.hpp"
#include "io/case.hpp"
#include "io/progress.hpp"

namespace breccia {

/// The spheres of a case, axis along z and middle at the origin.
Specimen make_specimen(const Case& c, Progress& progress);

/// What the scene of a case asks of the bond loop.
Features asked_features(const Case& c);

/// @param features  those that will run
Assembly make_assembly(const Case& c, const Features& features, int threads, Progress& progress);

}  // namespace breccia
