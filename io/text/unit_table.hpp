// The units that a quantity may have.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/units.hpp"

namespace breccia {

/// One unit is factor x 10^exponent in SI. Decimal units have factor 1, so that they only move the
/// decimal point.
struct Unit {
  std::string_view name;
  Dimension dimension;
  long double factor = 1;
  int exponent = 0;
  bool takes_prefix = false;
};

/// The unit of that name, its prefix taken into the exponent.
std::optional<Unit> find_unit(std::string_view name);

/// Names worth suggesting: every unit, of one dimension only if asked, and the prefixes that a
/// laboratory uses.
std::vector<std::string> unit_names(std::optional<Dimension> only);

}  // namespace breccia
