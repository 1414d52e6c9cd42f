#include "core/elastic/dashpots.hpp"

#include <numbers>

namespace breccia {
namespace {

/// c_n of a bond, before any scheme.
double whole_dashpot(const Dashpots& d, const ParticleTable& p, const BondTable& b, std::size_t k) {
  const Row lo = b.row_lo[k], hi = b.row_hi[k];
  double c = pair_dashpot(d.xi, p.mass[lo], p.mass[hi], b.stiffness[k]);
  if (d.paper_alpha > 0.0)
    // (P30)
    c *= std::numbers::pi * d.paper_alpha * std::min(p.radius[lo], p.radius[hi]) / b.rest_length[k];
  return c;
}

double held_back(const Dashpots& d, double c, double stiffness, double load, double dt) {
  if (d.held_step > 0.0) dt = d.held_step;
  switch (d.scheme) {
    case DampingScheme::explicit_:
      return c;
    case DampingScheme::capped:
      return capped_dashpot(c, stiffness, dt);
    case DampingScheme::summed:
      return summed_dashpot(c, load, dt);
  }
  return c;
}

}  // namespace

void sum_loads(Dashpots& d, const ParticleTable& p, const BondTable& b) {
  d.load.clear();
  if (d.scheme != DampingScheme::summed) return;
  d.load.assign(p.size, 0.0);
  for (std::size_t k = 0; k < b.size; ++k) {
    const double c = whole_dashpot(d, p, b, k);
    for (const Row end : {b.row_lo[k], b.row_hi[k]}) d.load[end] += c / p.mass[end];
  }
}

double bond_dashpot(const Dashpots& d, const ParticleTable& p, const BondTable& b, std::size_t k, double dt) {
  const double load = d.load.empty() ? 0.0 : std::max(d.load[b.row_lo[k]], d.load[b.row_hi[k]]);
  return held_back(d, whole_dashpot(d, p, b, k), b.stiffness[k], load, dt);
}

double contact_dashpot(const Dashpots& d, const ParticleTable& p, const ContactTable& c, std::size_t k,
                       double dt) {
  const Row lo = c.row_lo[k], hi = c.row_hi[k];
  const double whole = pair_dashpot(d.xi, p.mass[lo], p.mass[hi], c.stiffness[k]);
  const double load = d.load.empty() ? 0.0
                                     : std::max(d.load[lo] + whole / p.mass[lo],  //
                                                d.load[hi] + whole / p.mass[hi]);
  return held_back(d, whole, c.stiffness[k], load, dt);
}

}  // namespace breccia
