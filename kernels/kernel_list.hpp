// The kernels that are built per instruction set: each law for each of its feature sets, in the order of
// bond_laws.hpp, and one of them for mixed precision too. At most 27 over all instruction sets, for the sake
// of the time to build.
#pragma once
#include <array>
#include <cstddef>

#include "kernels/bond_laws.hpp"

namespace breccia {

struct KernelKind {
  std::size_t law = 0;  ///< index in BondLaw
  Features features;
};

inline constexpr std::size_t kernel_count = [] {
  std::size_t n = 0;
  for_each_law([&](const auto& law) { n += law.feature_sets.size(); });
  return n;
}();
static_assert(3 * (kernel_count + 1) <= 27);

inline constexpr std::array<KernelKind, kernel_count> kernel_list = [] {
  std::array<KernelKind, kernel_count> list{};
  std::size_t n = 0, law_index = 0;
  for_each_law([&](const auto& law) {
    for (const Features& f : law.feature_sets) list[n++] = {law_index, f};
    ++law_index;
  });
  return list;
}();

/// The Dempack law with all that it has.
inline constexpr std::size_t mixed_kernel = [] {
  std::size_t k = 0;
  while (kernel_list[k].law != 0 || !(kernel_list[k].features == Features{})) ++k;
  return k;
}();

template <std::size_t k>
using LawOfKernel = std::variant_alternative_t<kernel_list[k].law, BondLaw>;

}  // namespace breccia
