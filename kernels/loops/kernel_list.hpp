// The kernels that are built per instruction set: each law for each of its feature sets, in the
// order of bond_laws.hpp; once more with the energy ledger for the fullest of them. In single
// precision the fullest of each law, which keep the ledger where they are asked to.
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

/// Calls visit(KernelKind) for each in single precision. Moments of cement are a pass in doubles.
template <class Visit>
constexpr void for_each_single_kernel(Visit&& visit) {
  std::size_t law_index = 0;
  for_each_law([&]<class Law>(const Law& law) {
    for (const Features& f : law.feature_sets)
      if (is_fullest(law, f) && !passes_moments<Law>)
        visit(KernelKind{law_index, f, {Precision::single, false}});
    ++law_index;
  });
}

inline constexpr std::size_t single_count = [] {
  std::size_t n = 0;
  for_each_single_kernel([&](const KernelKind&) { ++n; });
  return n;
}();

inline constexpr std::array<KernelKind, single_count> single_list = [] {
  std::array<KernelKind, single_count> list{};
  std::size_t n = 0;
  for_each_single_kernel([&](const KernelKind& k) { list[n++] = k; });
  return list;
}();

template <std::size_t k>
using LawOfKernel = std::variant_alternative_t<kernel_list[k].law, BondLaw>;

}  // namespace breccia
