// The ways of storing and summing that the study compares; all of them run the same law.
#pragma once
#include <array>
#include <string_view>

#include "core/studies/layouts/stored_bonds.hpp"

namespace breccia {

/// records: position, velocity and spin of a particle side by side, its force and torque in a
/// record of their own (production). columns: each a column
enum class ParticleStorage { records, columns };

/// private_sums, gather: as in production. shared_atomic: production's `atomic`. all_atomic: every
/// add. colours: no two bonds of a colour share a particle; one colour after the other, with plain
/// adds
enum class Summation { private_sums, gather, shared_atomic, all_atomic, colours };

struct Layout {
  BondStorage bonds = BondStorage::columns;
  ParticleStorage particles = ParticleStorage::records;
  Summation sums = Summation::private_sums;
};

/// Production first; the others differ from it in one thing each.
inline constexpr std::array<Layout, 9> layouts{{{},
                                                {.bonds = BondStorage::records},
                                                {.bonds = BondStorage::blocks_8},
                                                {.bonds = BondStorage::blocks_16},
                                                {.particles = ParticleStorage::columns},
                                                {.sums = Summation::gather},
                                                {.sums = Summation::shared_atomic},
                                                {.sums = Summation::all_atomic},
                                                {.sums = Summation::colours}}};

std::string_view name_of(BondStorage);
std::string_view name_of(ParticleStorage);
std::string_view name_of(Summation);

}  // namespace breccia
