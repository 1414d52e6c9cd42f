// The dashpots of bonds and contacts: the paper's, and two schemes that hold back those too strong
// for the step. docs/model.md, "Time step and mass scaling".
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/scene_options.hpp"
#include "core/tables/bond_table.hpp"
#include "core/tables/contact_table.hpp"
#include "core/tables/particle_table.hpp"

namespace breccia {

/// c_n = 2 xi sqrt(m_ij k_n): the fraction xi of what is critical for the pair alone (S3.8), m_ij
/// by (P28).
/// @returns N s/m
inline double pair_dashpot(double xi, double mass_lo, double mass_hi, double stiffness) {
  return 2.0 * xi * std::sqrt(mass_lo * mass_hi / (mass_lo + mass_hi) * stiffness);  // (S3.8) (P28)
}

/// q of both schemes below.
constexpr double dashpot_share = 0.5;

/// min(c_n, q k_n dt) (B45): no network's critical step falls below 1/sqrt(1 + 2 q) of the
/// undamped.
inline double capped_dashpot(double c_n, double stiffness, double dt) {
  return std::min(c_n, dashpot_share * stiffness * dt);
}

/// c_n/(1 + q dt max(S_i/m_i, S_j/m_j)). (B46)
/// @param load  1/s, the larger of both ends' sums of c_n over mass
inline double summed_dashpot(double c_n, double load, double dt) {
  return c_n / (1.0 + dashpot_share * dt * load);
}

/// What makes the dashpots of a scene.
struct Dashpots {
  DampingScheme scheme = DampingScheme::explicit_;
  double xi = 0;             ///< 0: none
  double paper_alpha = 0;    ///< of the form "paper", times pi alpha r_c/d0 (P30); 0: without
  double held_step = 0;      ///< s, at which the schemes are evaluated; 0: the step of the run
  std::vector<double> load;  ///< 1/s, summed: S_i/m_i of each particle, S_i over its bonds
};

/// Sets `load`, where the scheme needs it.
void sum_loads(Dashpots& dashpots, const ParticleTable& particles, const BondTable& bonds);

/// N s/m, of a bond at a step.
double bond_dashpot(const Dashpots& dashpots, const ParticleTable& particles, const BondTable& bonds,
                    std::size_t k, double dt);

/// N s/m, of a contact at a step. Its ends' loads are those of their bonds and its own: what it is
/// does not depend on which other pairs the search has listed.
double contact_dashpot(const Dashpots& dashpots, const ParticleTable& particles, const ContactTable& contacts,
                       std::size_t k, double dt);

}  // namespace breccia
