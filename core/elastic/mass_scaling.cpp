#include "core/elastic/mass_scaling.hpp"

#include <algorithm>
#include <cmath>

namespace breccia {
namespace {

double scale_of(double own, double target) { return target > own ? (target / own) * (target / own) : 1.0; }

}  // namespace

MassScaling scale_masses(ParticleTable& p, std::span<const double> own, double factor) {
  double true_mass = 0.0;
  for (const double m : p.mass) true_mass += m;
  const auto total = [&](double target) {
    double sum = 0.0;
    for (std::size_t row = 0; row < p.size; ++row) sum += scale_of(own[row], target) * p.mass[row];
    return sum / true_mass;
  };
  double low = *std::min_element(own.begin(), own.end());
  if (!std::isfinite(low)) return {};  // nothing is stiff: nothing to gain
  double high = low;
  while (total(high) <= factor && high < 1e6 * low) high *= 2.0;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (total(middle) <= factor ? low : high) = middle;
  }
  MassScaling made;
  made.factor = total(low);
  for (std::size_t row = 0; row < p.size; ++row) {
    const double scale = scale_of(own[row], low);
    made.scaled += scale > 1.0;
    p.mass[row] *= scale;
  }
  return made;
}

}  // namespace breccia
