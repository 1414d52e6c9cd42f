#include "core/world/fracture_energies.hpp"

#include "kernels/laws/bond_laws.hpp"

namespace breccia {
namespace {

template <class LawOf>
FractureEnergies energies_under(const World& w, const LawOf& law_of) {
  double normal = 0, shear = 0, area = 0;
  for (std::size_t k = 0; k < w.bonds.size; ++k) {
    const auto& law = law_of(k);
    const BondConstants<double> bond = constants_of_bond(w.bonds, k);
    const auto limits = limits_of(law, bond);
    const double length = strain_length(law.young, bond);
    normal +=
        0.5 * limits.tension * limits.tension / bond.stiffness * (1.0 + delta_normal(law.failure, length));
    if (law.shear_ratio > 0)
      shear += 0.5 * limits.cohesion * limits.cohesion / (law.shear_ratio * bond.stiffness) *
               (1.0 + delta_shear(law.failure, length));
    area += bond.strength_area;
  }
  return {normal / area, shear / area};
}

}  // namespace

FractureEnergies fracture_energies(const World& w) {
  return with_laws(w.laws, w.bonds.law, [&](const auto& law_of) { return energies_under(w, law_of); });
}

}  // namespace breccia
