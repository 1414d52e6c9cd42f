// From what an engineer states to the constants that the bonds use.
#pragma once
#include "kernels/laws/bond_laws.hpp"

namespace breccia {

/// k_s/k_n: 1/(2(1 + nu)) (P36).
double paper_shear_ratio(double poisson_ratio);

/// k_s/k_n for which an affinely deformed assembly has this Poisson ratio: (1 - 4 nu)/(1 + nu) of
/// spheres, (1 - 3 nu)/(1 + nu) of discs in plane stress.
double matched_shear_ratio(double poisson_ratio, bool plane = false);

/// Constants of the material's law. @param shear_ratio  k_s/k_n that the elasticity asks for; the
/// law may scale it
BondLaw law_of(const Material& material, double shear_ratio);

}  // namespace breccia
