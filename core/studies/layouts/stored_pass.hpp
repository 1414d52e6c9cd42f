// The pass over bonds that are stored as records or blocks: the production's loop with another
// accessor, Dempack law, all features.
#pragma once
#include "core/studies/layouts/stored_bonds.hpp"
#include "kernels/loops/bond_pass.hpp"

namespace breccia {

/// Bonds [first, last), both multiples of `bond_batch`. Of `in`, the columns of constants but for
/// the arms are not read.
using StoredPass = void (*)(const BondPassIn& in, double* stored, std::size_t first, std::size_t last,
                            const Scatter&);

/// @throws std::invalid_argument for columns, which are production's
StoredPass stored_pass_for(BondStorage storage, InstructionSet set);

}  // namespace breccia
