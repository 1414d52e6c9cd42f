#include "core/bonding/law_of_material.hpp"

#include "core/base/error.hpp"

namespace breccia {

double paper_shear_ratio(double poisson_ratio) { return 0.5 / (1.0 + poisson_ratio); }  // (P36)

double matched_shear_ratio(double poisson_ratio, bool plane) {
  return (1.0 - (plane ? 3.0 : 4.0) * poisson_ratio) / (1.0 + poisson_ratio);  // (B16)
}

BondLaw law_of(const Material& material, double shear_ratio) {
  BondLaw law;
  bool found = false;
  for_each_law([&]<class Law>(const Law&) {
    if (Law::name != material.law) return;
    law = Law::of(material, shear_ratio);
    found = true;
  });
  if (!found) fail<BadInput>("material.law: no law \"{}\"", material.law);
  return law;
}

}  // namespace breccia
