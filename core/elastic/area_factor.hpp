// alpha: the factor on the bonds' areas that gives the specimen the stiffness asked for.
// docs/model.md, "Bonds".
#pragma once
#include "core/base/scene_options.hpp"
#include "core/bonding/assembly.hpp"
#include "kernels/laws/material.hpp"

namespace breccia {

struct AreaFactorRequest {
  AlphaRule rule = AlphaRule::automatic;
  double number = 1.0;  ///< when rule is number
  Elasticity elasticity = Elasticity::paper;
  Material material;  ///< with the E and nu wanted of the specimen
  bool rough_platens = true;
};

struct AreaFactor {
  double alpha = 1.0;
  double shear_ratio = 0;    ///< k_s/k_n
  double fabric = 0;         ///< T = sum of A d0/(3 V), of discs (2 V): 1 for areas that tile space
  double young_modulus = 0;  ///< Pa, of the specimen with this alpha, by the probe; 0 where none was made
  double poisson_ratio = 0;  ///< by the probe
  int probes = 0;
};

AreaFactor find_area_factor(const Assembly& assembly, const AreaFactorRequest& request, int threads);

}  // namespace breccia
