// The laws of a scene's bonds: one, or one for each pair of materials.
#pragma once
#include <span>

#include "core/tables/column_storage.hpp"
#include "kernels/laws/bond_laws.hpp"

namespace breccia {

/// Calls visit(law_of) with law_of(k) the law of row k of a table, all of one kind.
/// @param which  of the laws, by row; read where there are several
template <class Visit>
decltype(auto) with_laws(std::span<const BondLaw> laws, const Column<LawIndex>& which, const Visit& visit) {
  return std::visit(
      [&]<class Law>(const Law& first) -> decltype(auto) {
        return visit([&](std::size_t k) -> const Law& {
          return laws.size() == 1 ? first : *std::get_if<Law>(&laws[which[k]]);
        });
      },
      laws.front());
}

/// k_s/k_n
inline double shear_ratio_of(const BondLaw& law) {
  return std::visit([](const auto& l) { return l.shear_ratio; }, law);
}

/// Coulomb friction of what is broken.
inline double friction_of(const BondLaw& law) {
  return std::visit([](const auto& l) { return l.failure.friction_dynamic; }, law);
}

/// Number of row k of a table, of those that belong to laws.
inline double of_law(std::span<const double> numbers, const Column<LawIndex>& which, std::size_t k) {
  return numbers.size() == 1 ? numbers.front() : numbers[which[k]];
}

}  // namespace breccia
