#include "core/studies/layouts/layout.hpp"

namespace breccia {

std::string_view name_of(BondStorage storage) {
  constexpr std::array<std::string_view, 4> names{"columns", "records", "blocks of 8", "blocks of 16"};
  return names[static_cast<std::size_t>(storage)];
}

std::string_view name_of(ParticleStorage storage) {
  return storage == ParticleStorage::columns ? "columns" : "records";
}

std::string_view name_of(Summation sums) {
  constexpr std::array<std::string_view, 5> names{"private", "gather", "atomic", "all atomic", "colours"};
  return names[static_cast<std::size_t>(sums)];
}

}  // namespace breccia
