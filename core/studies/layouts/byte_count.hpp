// How many bytes a pass over the bonds has to move, from the columns as they are declared.
#pragma once
#include "core/tables/bond_table.hpp"
#include "core/tables/particle_table.hpp"

namespace breccia {

/// Of production's columns; a row of particles counts once in a pass, spread over the bonds.
struct ByteCount {
  double set = 0;      ///< B per bond, that the pass touches
  double read = 0;     ///< B per bond
  double written = 0;  ///< B per bond
  double moved() const { return read + written; }
};

/// Of bonds that neither yield nor break in the step: their plastic stretch and damages are not
/// written.
ByteCount bytes_per_bond(const BondTable& bonds, const ParticleTable& particles);

/// The same in single precision: blocks of bonds, records and sums of particles.
ByteCount single_bytes_per_bond(const BondTable& bonds, const ParticleTable& particles);

}  // namespace breccia
