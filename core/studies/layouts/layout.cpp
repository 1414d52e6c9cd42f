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

std::string_view numbers_of(const Layout& layout) {
  constexpr std::array<std::string_view, 3> names{"int32", "int64", "float"};
  return layout.precision == Precision::single ? names[static_cast<std::size_t>(layout.number)] : "double";
}

}  // namespace breccia
