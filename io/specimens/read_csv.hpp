// Spheres from .csv: id,x_m,y_m,z_m,r_m and optionally group.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/specimen.hpp"

namespace breccia {

/// @param name  of the file, for errors
/// @throws BadInput
std::vector<SpecimenSphere> spheres_from_csv(const std::string& name, std::string_view text);

}  // namespace breccia
