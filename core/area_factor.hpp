// alpha: the factor on the bonds' areas that gives the specimen the stiffness asked for. MODEL section 2.
#pragma once
#include "core/assembly.hpp"
#include "core/scene_options.hpp"

namespace breccia {

struct AreaFactorRequest {
  AlphaRule rule = AlphaRule::automatic;
  double number = 1.0;  ///< when rule is number
  Elasticity elasticity = Elasticity::paper;
  double young_modulus = 0;  ///< Pa, wanted of the specimen
  double poisson_ratio = 0;
  bool rough_platens = true;
};

struct AreaFactor {
  double alpha = 1.0;
  double shear_ratio = 0;    ///< k_s/k_n
  double fabric = 0;         ///< T = sum of pi r_c^2 d0/(3 V): 1 for areas that tile space
  double young_modulus = 0;  ///< Pa, of the specimen with this alpha, by the probe; 0 where none was made
  double poisson_ratio = 0;  ///< by the probe
  int probes = 0;
};

AreaFactor find_area_factor(const Assembly& assembly, const AreaFactorRequest& request, int threads);

}  // namespace breccia
