// The bond laws that there are, one line each.
#pragma once
#include <cstdint>
#include <variant>

#include "kernels/laws/contact_bond.hpp"
#include "kernels/laws/dempack.hpp"
#include "kernels/laws/exponential.hpp"
#include "kernels/laws/kdem.hpp"
#include "kernels/laws/parallel_bond.hpp"

namespace breccia {

using BondLaw = std::variant<DempackLaw,      //
                             ExponentialLaw,  //
                             KdemLaw,         //
                             ContactBondLaw,  //
                             ParallelBondLaw>;

/// Which of a scene's laws, where it has several materials.
using LawIndex = std::uint8_t;

/// Calls visit(type) with a default-made law of each kind; its constants mean nothing.
template <class Visit>
constexpr void for_each_law(Visit&& visit) {
  [&]<std::size_t... k>(std::index_sequence<k...>) { (visit(std::variant_alternative_t<k, BondLaw>{}), ...); }
  (std::make_index_sequence<std::variant_size_v<BondLaw>>{});
}

}  // namespace breccia
