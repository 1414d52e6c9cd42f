// How a test is run, as far as it costs time and changes the answer: what breccia-workprecision
// varies.
#pragma once
#include <string>
#include <string_view>

#include "core/base/scatter_name.hpp"
#include "core/base/scene_options.hpp"
#include "kernels/laws/features.hpp"
#include "kernels/loops/integrate.hpp"

namespace breccia {

struct Recipe {
  double safety = 0.8;        ///< step over the critical one
  double platen_speed = 0.1;  ///< m/s, of each platen
  DampingScheme scheme = DampingScheme::explicit_;
  double mass_factor = 1;  ///< of the total mass; 1: true masses
  GlobalDamping damping{0.1, 0.1};
  Precision precision = Precision::full;
  ScatterKind scatter = ScatterKind::private_sums;
};

/// Everything in a line; equal if and only if the recipes are. "step 0.8, 0.1 m/s, explicit, mass
/// 1, damping 0.1, full, private"
std::string describe(const Recipe& recipe);

/// What a case says for it, TOML.
std::string case_lines(const Recipe& recipe);

/// Steps that it takes, over those of another: by step and speed alone. What schemes and heavier
/// masses win depends on the specimen.
double steps_over(const Recipe& recipe, const Recipe& other);

}  // namespace breccia
