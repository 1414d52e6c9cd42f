// The instruction sets that the wide loops are compiled for; the choice is made once, at start.
#pragma once
#include <string_view>

namespace breccia {

enum class InstructionSet { x86_64, x86_64_v3, x86_64_v4 };

std::string_view name_of(InstructionSet);

/// Of one thing built per instruction set, the one of `set`.
template <class T>
constexpr const T& built_for(InstructionSet set, const T& x86_64, const T& x86_64_v3, const T& x86_64_v4) {
  return set == InstructionSet::x86_64 ? x86_64 : set == InstructionSet::x86_64_v3 ? x86_64_v3 : x86_64_v4;
}

/// The widest set that this processor runs, or the one that the environment's
/// BRECCIA_INSTRUCTION_SET names: with x86-64 every processor computes the same bits.
/// @throws std::invalid_argument when the processor does not have it
InstructionSet best_instruction_set();

}  // namespace breccia
