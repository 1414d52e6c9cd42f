#include "core/elastic/area_factor.hpp"

#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/bonding/law_of_material.hpp"
#include "core/bonding/section_area.hpp"
#include "core/elastic/elastic_network.hpp"
#include "core/tables/laws.hpp"

namespace breccia {
namespace {

double fabric_of(const Assembly& a) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.bonds.size; ++k) sum += a.bonds.area[k] * a.bonds.rest_length[k];
  return sum / ((a.space == Space::two_d ? 2.0 : 3.0) * a.volume());  // (B13)
}

/// (B14): E = alpha T E (2 + 3 kappa)/(4 + kappa), discs: 2 alpha T E (1 + kappa)/(3 + kappa) in
/// plane stress; an upper bound on the stiffness.
double affine_alpha(double fabric, double kappa, Space space) {
  if (space == Space::two_d) return (3.0 + kappa) / (2.0 + 2.0 * kappa) / fabric;
  return (4.0 + kappa) / (2.0 + 3.0 * kappa) / fabric;
}

/// The specimen with alpha = 1: what its ends and lateral surface answer. (B15)
ElasticResponse probe_with(const Assembly& a, const AreaFactorRequest& r, double kappa, int threads,
                           const Touching& touching) {
  const BondLaw law = law_of(r.material, kappa);
  const double ratio = shear_ratio_of(law);
  return probe(a, bond_stiffness({&law, 1}, a.particles, a.bonds), {&ratio, 1}, r.rough_platens, threads,
               touching);
}

/// (B104): (B14) with the bonds' own area through levels of the middle part instead of T of the
/// whole body. T counts the poor neighbourhoods of walls and ends too, which makes its alpha 5 to
/// 40 % too large for 13,000 to 100 spheres; this one is right to 6 % in packings.
double affine_of_levels(const Assembly& a, const Material& material, double kappa) {
  const BondLaw law = law_of(material, kappa);
  const double ratio = shear_ratio_of(law);
  std::vector<double> area = bond_stiffness({&law, 1}, a.particles, a.bonds);
  for (std::size_t k = 0; k < area.size(); ++k) area[k] *= a.bonds.rest_length[k] / material.young_modulus;
  const double reach = 0.4 * a.length();  // the levels of the thesis' table 5.1, away from the ends
  const double through = area_through_levels(a.particles, a.bonds, area, -reach, reach, 41).mean;
  return affine_alpha(through / a.section(), ratio, a.space);
}

}  // namespace

Touching touching_of(const Assembly& a, const Material& material, double kappa, int threads) {
  const BondLaw law = law_of(material, kappa);
  return touching_pairs(a, material.young_modulus, friction_of(law), threads);
}

namespace {

/// (P22): 40 P/N_c, with P the porosity (a fraction) and N_c the coordination number.
double porosity_alpha(const Assembly& a) {
  double solid = 0.0;
  for (const double r : a.particles.radius) solid += 4.0 / 3.0 * std::numbers::pi * r * r * r;
  return 40.0 * (1.0 - solid / a.volume()) / a.coordination;  // (P22)
}

/// k_s/k_n at which the probe shows the Poisson ratio asked for: secant steps from the affine
/// value. (B16)
double matched_ratio(const Assembly& a, const AreaFactorRequest& r, int threads, const Touching& touching,
                     ElasticResponse& answer, int& probes) {
  const auto miss = [&](double kappa) {
    answer = probe_with(a, r, kappa, threads, touching);
    ++probes;
    return answer.poisson_ratio - r.material.poisson_ratio;
  };
  const double tolerance = 0.002 * std::max(r.material.poisson_ratio, 0.05);
  double k0 = matched_shear_ratio(r.material.poisson_ratio, a.space == Space::two_d), f0 = miss(k0);
  if (std::abs(f0) < tolerance) return k0;
  double k1 = std::max(0.0, k0 + 1.2 * f0 * 5.0 / 2.0),
         f1 = miss(k1);  // d nu/d kappa of the affine form is near -5/16 .. -1/4
  for (int turn = 0; turn < 12 && std::abs(f1) >= tolerance; ++turn) {
    const double k2 = std::max(0.0, k1 - f1 * (k1 - k0) / (f1 - f0));
    k0 = k1, f0 = f1;
    k1 = k2, f1 = miss(k1);
    if (k1 == k0) break;
  }
  if (std::abs(f1) >= tolerance)
    fail<BadInput>(
        "bonds.elasticity: \"matched\" finds no k_s/k_n that gives this specimen a Poisson ratio of {} "
        "(reached {:.4f}); "
        "ask for one nearer to that, or use \"paper\"",
        r.material.poisson_ratio, answer.poisson_ratio);
  return k1;
}

}  // namespace

AreaFactor find_area_factor(const Assembly& a, const AreaFactorRequest& r, int threads) {
  AreaFactor f;
  f.fabric = fabric_of(a);
  const bool matched = r.elasticity == Elasticity::matched;
  f.shear_ratio = matched ? matched_shear_ratio(r.material.poisson_ratio, a.space == Space::two_d)
                          : paper_shear_ratio(r.material.poisson_ratio);
  switch (r.rule) {
    case AlphaRule::number:
      f.alpha = r.number;
      return f;
    case AlphaRule::porosity:
      f.alpha = porosity_alpha(a);
      return f;
    case AlphaRule::affine:
      f.alpha = affine_alpha(f.fabric, f.shear_ratio, a.space);
      return f;
    case AlphaRule::automatic:
      break;
  }
  const Touching touching = r.contacts ? touching_of(a, r.material, f.shear_ratio, threads) : Touching{};
  ElasticResponse answer;
  if (matched) {
    f.shear_ratio = matched_ratio(a, r, threads, touching, answer, f.probes);
  } else {
    answer = probe_with(a, r, f.shear_ratio, threads, touching);
    f.probes = 1;
  }
  // the network is linear: the modulus is proportional to alpha
  f.alpha = r.material.young_modulus / answer.young_modulus;  // (B15)
  // but where moments go with its square
  for (double off = a.cement ? 1.0 : 0.0; std::abs(off) > 1e-4 && f.probes < 12; ++f.probes) {
    Assembly scaled = a;
    for (double& area : scaled.bonds.area) area *= f.alpha;
    Touching pressed = touching;
    for (double& stiffness : pressed.contacts.stiffness) stiffness *= f.alpha;
    answer = probe_with(scaled, r, f.shear_ratio, threads, pressed);
    off = r.material.young_modulus / answer.young_modulus - 1.0;
    f.alpha *= 1.0 + off;
  }
  f.young_modulus = r.material.young_modulus;
  f.poisson_ratio = answer.poisson_ratio;
  f.affine = affine_of_levels(a, r.material, f.shear_ratio);
  return f;
}

}  // namespace breccia
