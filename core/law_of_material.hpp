// From what an engineer states to the constants that the bonds use.
#pragma once
#include "core/material.hpp"
#include "kernels/dempack.hpp"

namespace breccia {

/// Onate et al. 2015, eqs. 30, 36: k_s/k_n = 1/(2(1 + nu)).
double paper_shear_ratio(double poisson_ratio);

/// k_s/k_n for which an affinely deformed assembly has this Poisson ratio: (1 - 4 nu)/(1 + nu).
double matched_shear_ratio(double poisson_ratio);

/// Constants of the Dempack law. @param shear_ratio  k_s/k_n
DempackLaw law_of(const Material& material, double shear_ratio);

}  // namespace breccia
