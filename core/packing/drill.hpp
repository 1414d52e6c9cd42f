// A packing that is drilled along its axis.
#pragma once
#include "core/geometry/specimen.hpp"

namespace breccia {

/// Leaves out the spheres whose centres lie within the body's hole.
Specimen drilled(Specimen specimen, const Body& body);

}  // namespace breccia
