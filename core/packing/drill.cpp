#include "core/packing/drill.hpp"

#include <cmath>

namespace breccia {

Specimen drilled(Specimen specimen, const Body& body) {
  std::erase_if(specimen.spheres, [&](const SpecimenSphere& s) {
    return std::hypot(s.centre.x, s.centre.y) < 0.5 * body.hole;
  });
  return specimen;
}

}  // namespace breccia
