// Spheres from .mdpa, the model files of Kratos.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/specimen.hpp"

namespace breccia {

/// The nodes that carry a spheric element, under the node's id; NodalData RADIUS and
/// COHESIVE_GROUP. A node without a group has 0 where the file has such a block, else 1.
/// @param name  of the file, for errors
/// @throws BadInput
std::vector<SpecimenSphere> spheres_from_mdpa(const std::string& name, std::string_view text);

}  // namespace breccia
