// The kernels that are built per instruction set: each law for each of its feature sets, in the
// order of bond_laws.hpp; once more with the energy ledger for the fullest of them; and the Dempack
// law with all that it has in mixed precision, with and without the ledger.
#pragma once
#include <array>
#include <cstddef>

#include "kernels/laws/bond_laws.hpp"

namespace breccia {

struct KernelKind {
  std::size_t law = 0;  ///< index in BondLaw
  Features features;
  LoopKind kind;
};

/// True when no other set of the law has all that `features` has; what unloads elsewhere, and what
/// has several materials, stands by itself, since others would pay for it.
template <class Law>
constexpr bool is_fullest(const Law& law, const Features& features) {
  for (const Features& other : law.feature_sets)
    if (!(other == features) && other.unloading == features.unloading && other.several == features.several &&
        other.covers(features))
      return false;
  return true;
}

/// Calls visit(KernelKind) for each kernel, in order.
template <class Visit>
constexpr void for_each_kernel(Visit&& visit) {
  std::size_t law_index = 0;
  for_each_law([&](const auto& law) {
    for (const Features& f : law.feature_sets) {
      visit(KernelKind{law_index, f, {}});
      if (is_fullest(law, f)) visit(KernelKind{law_index, f, {Precision::full, true}});
    }
    ++law_index;
  });
  for (const bool ledger : {false, true}) visit(KernelKind{0, {}, {Precision::mixed, ledger}});
}

inline constexpr std::size_t kernel_count = [] {
  std::size_t n = 0;
  for_each_kernel([&](const KernelKind&) { ++n; });
  return n;
}();

inline constexpr std::array<KernelKind, kernel_count> kernel_list = [] {
  std::array<KernelKind, kernel_count> list{};
  std::size_t n = 0;
  for_each_kernel([&](const KernelKind& k) { list[n++] = k; });
  return list;
}();

template <std::size_t k>
using LawOfKernel = std::variant_alternative_t<kernel_list[k].law, BondLaw>;

}  // namespace breccia
