// A material whose values stand in a table over the confinement: [[at]] of a preset,
// [[material.at]] of a case.
#pragma once
#include <string>
#include <vector>

#include "io/cases/keys_material.hpp"

namespace breccia {

/// The material of a run, and where in the table it was found.
struct MaterialAt {
  Layer layer;
  std::vector<double> used;  ///< Pa, confinements of the table that it comes from: one, or the two around it
  std::string from;          ///< in words; empty where the material is the same at every confinement
  std::string warning;       ///< empty where the table has an answer
};

/// The material at a confinement: --set, the case's [[material.at]], [material], the preset's
/// [[at]], the preset. At a confinement of the table its values hold to the last bit, between two
/// of them straight lines; values that stand for no confinement are those of zero. Beyond the table
/// its last values hold, with a warning.
/// @throws BadInput where one of two neighbours has a key and the other the one that replaces it
MaterialAt material_at(const MaterialLayers&, double confinement);

/// The keys of the material that its table changes, with their values at one confinement, one line.
std::string describe_varying(const MaterialLayers&, const Layer& at);

}  // namespace breccia
