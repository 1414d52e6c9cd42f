// The limits of a bond in compression, from those that a case states.
#pragma once
#include "core/base/scene_options.hpp"
#include "kernels/laws/material.hpp"

namespace breccia {

/// Pa: the mean compressive stress of bonds whose specimen is under a pressure: p/(alpha T).
/// (B108)
/// @param alpha, fabric  of the areas: their factor, and how many times they tile space (B13)
double hydrostatic_bond_stress(double pressure, double alpha, double fabric);

struct HydrostaticBranch {
  HydrostaticResponse response = HydrostaticResponse::law;
  double pressure = 0;  ///< Pa, of stage 1
};

/// A material whose limits are those of bonds in a test: turned from macroscopic to bond stresses
/// (B109), then raised by what stage 1 loads a bond, so that loading starts elastic (B108).
/// @returns  the same material where its law has no limits
Material with_bond_limits(const Material& material, const HydrostaticBranch& branch, double alpha,
                          double fabric);

}  // namespace breccia
