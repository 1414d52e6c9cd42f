// The ways of storing and summing that the study compares; all of them run the same law.
#pragma once
#include <array>
#include <string_view>

#include "core/studies/layouts/stored_bonds.hpp"
#include "kernels/laws/features.hpp"

namespace breccia {

/// records: position, velocity and spin of a particle side by side, its force and torque in a
/// record of their own (production's). columns: each a column
enum class ParticleStorage { records, columns };

/// Of single precision, what sums are made of: production's integers of 32 bits, or of 64, or
/// floats
enum class SumNumber { int32, int64, float32 };

/// private_sums, gather: as in production. shared_atomic: production's `atomic`. all_atomic: every
/// add. colours: no two bonds of a colour share a particle; one colour after the other, with plain
/// adds
enum class Summation { private_sums, gather, shared_atomic, all_atomic, colours };

struct Layout {
  BondStorage bonds = BondStorage::columns;
  ParticleStorage particles = ParticleStorage::records;
  Summation sums = Summation::private_sums;
  Precision precision = Precision::full;
  SumNumber number = SumNumber::int32;
};

/// Production in single precision first, with what differs from it in one thing each; then
/// production in doubles, with what differs from that. In single precision bonds lie in blocks of
/// 16 and particles in records of 64 bytes.
inline constexpr Layout single_layout{.bonds = BondStorage::blocks_16, .precision = Precision::single};
inline constexpr std::array<Layout, 13> layouts{
    {single_layout,
     {.bonds = BondStorage::blocks_16, .sums = Summation::shared_atomic, .precision = Precision::single},
     {.bonds = BondStorage::blocks_16, .precision = Precision::single, .number = SumNumber::int64},
     {.bonds = BondStorage::blocks_16, .precision = Precision::single, .number = SumNumber::float32},
     {},
     {.bonds = BondStorage::records},
     {.bonds = BondStorage::blocks_8},
     {.bonds = BondStorage::blocks_16},
     {.particles = ParticleStorage::columns},
     {.sums = Summation::gather},
     {.sums = Summation::shared_atomic},
     {.sums = Summation::all_atomic},
     {.sums = Summation::colours}}};

/// What its sums are made of.
std::string_view numbers_of(const Layout&);
std::string_view name_of(BondStorage);
std::string_view name_of(ParticleStorage);
std::string_view name_of(Summation);

}  // namespace breccia
