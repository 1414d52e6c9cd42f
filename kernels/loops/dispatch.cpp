// Chooses the wide loops: by the scene's features and the processor, once at start.
#include <array>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <tuple>

#include "kernels/loops/bond_pass.hpp"
#include "kernels/loops/integrate.hpp"
#include "kernels/loops/kernel_list.hpp"
#include "kernels/loops/undamaged_energy.hpp"

namespace breccia {

namespace x86_64 {
extern const std::array<BondPass, kernel_list.size()> passes;
Integrated integrate_free(const Motion&, std::size_t, std::size_t, double, const GlobalDamping&, bool);
double undamaged_energy(const BondEnergyIn&, std::size_t, std::size_t);
}  // namespace x86_64
namespace x86_64_v3 {
extern const std::array<BondPass, kernel_list.size()> passes;
Integrated integrate_free(const Motion&, std::size_t, std::size_t, double, const GlobalDamping&, bool);
double undamaged_energy(const BondEnergyIn&, std::size_t, std::size_t);
}  // namespace x86_64_v3
namespace x86_64_v4 {
extern const std::array<BondPass, kernel_list.size()> passes;
Integrated integrate_free(const Motion&, std::size_t, std::size_t, double, const GlobalDamping&, bool);
double undamaged_energy(const BondEnergyIn&, std::size_t, std::size_t);
}  // namespace x86_64_v4

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

namespace {

/// What of x86-64-v3 and -v4 the loops are compiled to: compilers know the levels by name only of
/// late.
bool has_v3() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") &&
         __builtin_cpu_supports("bmi2");
}
bool has_v4() {
#if defined(__clang__)
  return false;  // clang 16 drops the masks of libstdc++'s wide registers of 512 bits: select(m, a, b) is b
#endif
  return has_v3() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512vl");
}

/// @throws std::invalid_argument
InstructionSet set_named(std::string_view wanted) {
  const std::array<std::tuple<std::string_view, InstructionSet, bool>, 3> sets{
      {{"x86-64", InstructionSet::x86_64, true},
       {"x86-64-v3", InstructionSet::x86_64_v3, has_v3()},
       {"x86-64-v4", InstructionSet::x86_64_v4, has_v4()}}};
  for (const auto& [name, set, here] : sets)
    if (here && wanted == name) return set;
  throw std::invalid_argument("BRECCIA_INSTRUCTION_SET: this processor has no \"" + std::string(wanted) +
                              "\"; valid: x86-64, x86-64-v3, x86-64-v4, as far as it has them");
}

}  // namespace

InstructionSet best_instruction_set() {
  if (const char* wanted = std::getenv("BRECCIA_INSTRUCTION_SET"); wanted && *wanted)
    return set_named(wanted);
  if (has_v4()) return InstructionSet::x86_64_v4;
  if (has_v3()) return InstructionSet::x86_64_v3;
  return InstructionSet::x86_64;
}

IntegrateFree integrate_free_for(InstructionSet set) {
  return built_for<IntegrateFree>(set, x86_64::integrate_free, x86_64_v3::integrate_free,
                                  x86_64_v4::integrate_free);
}

UndamagedEnergy undamaged_energy_for(InstructionSet set) {
  return built_for<UndamagedEnergy>(set, x86_64::undamaged_energy, x86_64_v3::undamaged_energy,
                                    x86_64_v4::undamaged_energy);
}

Features built_features(const BondLaw& law, const Features& asked, const LoopKind& kind) {
  if (kind.precision == Precision::single)
    for (const KernelKind& k : single_list)
      if (k.law == law.index() && k.features.covers(asked)) return k.features;
  for (const KernelKind& k : kernel_list)
    if (k.law == law.index() && k.features.covers(asked) && k.kind == kind) return k.features;
  throw std::invalid_argument("no bond kernel of this law covers the scene's features");
}

BondPass bond_pass_for(const BondLaw& law, const Features& built, InstructionSet set, const LoopKind& kind) {
  for (std::size_t k = 0; k < kernel_list.size(); ++k)
    if (kernel_list[k].law == law.index() && kernel_list[k].features == built && kernel_list[k].kind == kind)
      return built_for(set, x86_64::passes, x86_64_v3::passes, x86_64_v4::passes)[k];
  throw std::invalid_argument("no bond kernel is built for these features in this kind of loop");
}

}  // namespace breccia
