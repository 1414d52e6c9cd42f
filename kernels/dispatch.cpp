// Chooses the kernel of the bond pass: by the scene's features and the processor, once at start.
#include <stdexcept>

#include "kernels/bond_pass.hpp"
#include "kernels/built_features.hpp"

namespace breccia {

namespace x86_64 {
extern const std::array<BondPass, built_feature_sets.size()> passes;
}
namespace x86_64_v3 {
extern const std::array<BondPass, built_feature_sets.size()> passes;
}
namespace x86_64_v4 {
extern const std::array<BondPass, built_feature_sets.size()> passes;
}

std::string_view name_of(InstructionSet set) {
  switch (set) {
    case InstructionSet::x86_64:
      return "x86-64";
    case InstructionSet::x86_64_v3:
      return "x86-64-v3 (AVX2)";
    case InstructionSet::x86_64_v4:
      return "x86-64-v4 (AVX-512)";
  }
  return "?";
}

InstructionSet best_instruction_set() {
  if (__builtin_cpu_supports("x86-64-v4")) return InstructionSet::x86_64_v4;
  if (__builtin_cpu_supports("x86-64-v3")) return InstructionSet::x86_64_v3;
  return InstructionSet::x86_64;
}

Features built_features(const Features& asked) {
  for (const Features& built : built_feature_sets)
    if (built.covers(asked)) return built;
  throw std::logic_error("no bond kernel covers the scene's features");
}

BondPass bond_pass_for(const Features& built, InstructionSet set) {
  for (std::size_t k = 0; k < built_feature_sets.size(); ++k) {
    if (!(built_feature_sets[k] == built)) continue;
    switch (set) {
      case InstructionSet::x86_64:
        return x86_64::passes[k];
      case InstructionSet::x86_64_v3:
        return x86_64_v3::passes[k];
      case InstructionSet::x86_64_v4:
        return x86_64_v4::passes[k];
    }
  }
  throw std::logic_error("no bond kernel is built for these features");
}

}  // namespace breccia
