// The case of breccia-impact: free particles, walls, their materials. A kind of its own beside the
// laboratory tests.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/impact/impact.hpp"

namespace breccia {

struct ImpactCase {
  ImpactScene scene;
  std::vector<std::string> material_names;  ///< of scene.materials
  std::string spheres_file;                 ///< empty where there is none
  std::string resolved;                     ///< the whole case as TOML, every default written out
};

/// Reads, checks and resolves a case file.
/// @param sets  `--set` overrides: "contact.law=linear", "materials.glass.restitution=0.5",
/// "particle.2.spin=[0, 0, 1]"
///              (particles and walls are counted from 1)
/// @throws BadInput: one line with file, line, key and the nearest valid choice
ImpactCase load_impact_case(const std::filesystem::path& file, const std::vector<std::string>& sets);

/// The keys, one a line: name, what is valid, default, meaning. For `--help`.
std::string describe_impact_keys();

}  // namespace breccia
