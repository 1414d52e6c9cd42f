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

/// The widest set that this processor runs.
InstructionSet best_instruction_set();

}  // namespace breccia
