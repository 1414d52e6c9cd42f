// A fingerprint of the state of a run: equal if and only if (but for one chance in 2^64) every
// saved bit is equal.
#pragma once
#include <string>

#include "core/tables/bond_table.hpp"
#include "core/tables/particle_table.hpp"

namespace breccia {

/// 16 hex digits over the identity, history and state columns in the order of their declaration,
/// rows by global id.
std::string state_hash(const ParticleTable& particles, const BondTable& bonds);

}  // namespace breccia
