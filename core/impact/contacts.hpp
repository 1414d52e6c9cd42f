// Who may touch whom in an impact scene, with the constants of each contact and what it remembers.
#pragma once
#include "core/impact/impact.hpp"
#include "core/tables/particle_table.hpp"
#include "core/tables/table.hpp"

namespace breccia {

// clang-format off
#define BRECCIA_IMPACT_CONTACT_COLUMNS(COLUMN)                                                                        \
  COLUMN(Row,    row,         "1",        identity,  always,   "row of the particle, of a pair the lower one")        \
  COLUMN(Row,    partner,     "1",        identity,  always,   "row of the other particle, or number of the wall")    \
  COLUMN(double, normal,      "N/m^1.5",  reference, always,   "4/3 E* sqrt(R*); linear law: k_n, N/m")               \
  COLUMN(double, tangential,  "N/m^1.5",  reference, always,   "8 G* sqrt(R*); linear law: k_s, N/m")                 \
  COLUMN(double, damping,     "kg^0.5",   reference, always,   "dashpot over sqrt(dF/du); linear law: N s/m")         \
  COLUMN(double, friction,    "1",        reference, always,   "Coulomb")                                             \
  COLUMN(double, lever,       "m",        reference, always,   "of rolling friction, mu_r R*")                        \
  COLUMN(double, overlap,     "m",        history,   always,   "at the last step; 0: apart")                          \
  COLUMN(Vec3,   shear_force, "N",        history,   always,   "friction force on `row`")                             \
  COLUMN(Vec3,   rolling,     "N m",      history,   rotation, "torque of rolling friction on `row`")
// clang-format on

struct ImpactContactTable {
  BRECCIA_TABLE(BRECCIA_IMPACT_CONTACT_COLUMNS)
};

/// Constants of one contact; what the columns of the same names hold.
struct ImpactConstants {
  double normal = 0, tangential = 0, damping = 0, friction = 0, lever = 0;
};

ImpactConstants pair_constants(const ImpactScene& scene, std::size_t i, std::size_t j);
/// Against a flat and heavy body of that material, as a wall is.
ImpactConstants wall_constants(const ImpactScene& scene, std::size_t i, std::size_t material);

/// kg
double mass_of(const ImpactScene& scene, const ImpactParticle& particle);

/// Slopes of the normal and tangential force at an overlap, N/m, and the dashpots beside them, N
/// s/m.
struct ContactSlopes {
  double normal = 0, tangential = 0, damping = 0, tangential_damping = 0;
};
ContactSlopes slopes_at(ContactLaw law, const ImpactConstants& c, double overlap);

/// What turning adds to a tangential spring on a solid sphere: 1 + 5/2.
inline constexpr double rolling_factor = 3.5;

/// What one end of a contact asks of the step: dt is stable while this is below the end's mass
/// (B40).
double step_demand(const ContactSlopes& slopes, double dt);

/// Both lists of candidates, renewed when particles have used up the skin.
struct ImpactSearch {
  double skin = 0;         ///< m
  Column<Vec3> position;   ///< m, when the lists were made
  double wall_speed = 0;   ///< m/s, of the fastest point of a wall's surface near a particle
  double walls_moved = 0;  ///< m, at most, since the lists were made
  std::uint64_t rebuilds = 0;
};

/// True when two particles may have come near that are not on the list.
bool rebuild_is_due(const ImpactSearch& search, const ParticleTable& particles);

/// New lists, sorted by row and partner, with the memory of the contacts that were on the old ones.
/// @param placed  the walls at this time, s
void renew_contacts(ImpactSearch& search, const ImpactScene& scene, std::span<const Wall> placed, double time,
                    const ParticleTable& particles, ImpactContactTable& pairs, ImpactContactTable& walls);

/// m, from the centre of a motion to the far side of the farthest particle.
double reach_of(const WallMotion& motion, double time, std::span<const Vec3> position,
                std::span<const double> radius);

}  // namespace breccia
