// Do the areas of the bonds add up to the body? What passes through horizontal levels, against the
// section.
#pragma once
#include <span>
#include <vector>

#include "core/tables/bond_table.hpp"
#include "core/tables/particle_table.hpp"

namespace breccia {

/// (B90): sum of area |n_z| over the bonds whose ends lie on either side of the level z, m^2; n
/// along the bond. The areas between a strip of particles and those above it or below it
/// (Santasusana, table 5.1) are those through its upper and lower level. Areas that tile the body
/// give its section.
/// @param area   m^2, of each bond
/// @param level  m
double area_through(const ParticleTable& particles, const BondTable& bonds, std::span<const double> area,
                    double level);

struct AreaThroughLevels {
  double mean = 0, least = 0, most = 0;  ///< m^2
};

/// The same over `levels` levels evenly spaced from `low` to `high`.
/// @throws BadInput: no level, or areas that are not one for each bond
AreaThroughLevels area_through_levels(const ParticleTable& particles, const BondTable& bonds,
                                      std::span<const double> area, double low, double high, int levels);

}  // namespace breccia
