// Why a run has lost its way, as far as the state tells: the likely cause in words, and what to
// change.
#pragma once
#include <optional>
#include <string>

#include "core/world/world.hpp"

namespace breccia {

/// (B59): the largest sqrt(k_n/m) d0 of all bonds, m their reduced mass: the speed at which a
/// stretch of one runs along the stiffest of them. A particle as fast would strain its bonds by
/// one, hundreds of times what any material stands.
/// @returns m/s, of this rank's bonds; without bonds infinite
double fastest_wave(const World& world);

/// The likely cause of what a particle does, and what to change.
std::string advice(const World& world, Row row);

/// For a particle that has left, with a step that was right.
std::string advice_for_lost(const World& world, Row row);

/// So far from the origin places are rounded to more than a step moves them, while velocities are
/// not: shear forces, which are summed from velocities, then grow without a motion.
/// @param farthest  m, largest coordinate of a particle
/// @param size      m, of the specimen
/// @returns nothing where the specimen is near enough
std::optional<std::string> advice_far_away(double farthest, double size);

}  // namespace breccia
