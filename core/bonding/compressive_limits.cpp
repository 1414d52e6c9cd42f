#include "core/bonding/compressive_limits.hpp"

namespace breccia {

double hydrostatic_bond_stress(double pressure, double alpha, double fabric) {
  return pressure / (alpha * fabric);  // (B108)
}

Material with_bond_limits(const Material& material, const HydrostaticBranch& branch, double alpha,
                          double fabric) {
  Material m = material;
  if (!(alpha * fabric > 0.0)) return m;
  if (m.limits == LimitStress::macroscopic) {  // (B109)
    for (double& limit : m.limit_compressive_stress) limit = hydrostatic_bond_stress(limit, alpha, fabric);
    if (m.yield_stress) *m.yield_stress = hydrostatic_bond_stress(*m.yield_stress, alpha, fabric);
  }
  m.limits = LimitStress::bond;
  if (branch.response == HydrostaticResponse::elastic) {  // (B108)
    const double raised = hydrostatic_bond_stress(branch.pressure, alpha, fabric);
    for (double& limit : m.limit_compressive_stress) limit += raised;
    if (m.yield_stress) *m.yield_stress += raised;
  }
  return m;
}

}  // namespace breccia
