// The pass over bonds that are stored as records or blocks: the production's loop with another
// accessor, Dempack law, all features.
#pragma once
#include "core/studies/layouts/layout.hpp"
#include "kernels/loops/bond_pass.hpp"
#include "kernels/single/single.hpp"

namespace breccia {

/// Bonds [first, last), both multiples of `bond_batch`. Of `in`, the columns of constants but for
/// the arms are not read.
using StoredPass = void (*)(const BondPassIn& in, double* stored, std::size_t first, std::size_t last,
                            const Scatter&);

/// @throws std::invalid_argument for columns, which are production's
StoredPass stored_pass_for(BondStorage storage, InstructionSet set);

/// Sums of other numbers than production's: of a particle's force, and moment over the radius.
template <class Number>
struct alignas(8 * sizeof(Number)) SumsOf {
  Number force[4] = {}, moment[4] = {};
};
using LongSums = SumsOf<std::int64_t>;
using FloatSums = SumsOf<float>;

/// The loop in single precision with sums of other numbers than production's, LongSums or
/// FloatSums. Dempack law, all features.
using SumsPass = void (*)(const SinglePassIn& in, void* sums, std::size_t first, std::size_t last,
                          std::vector<LoadApart>& apart);

/// @throws std::invalid_argument for production's
SumsPass sums_pass_for(SumNumber number, InstructionSet set);

}  // namespace breccia
