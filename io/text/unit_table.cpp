#include "io/text/unit_table.hpp"

#include <array>

namespace breccia {
namespace {

constexpr Dimension energy{1, 2, -2}, watt{1, 2, -3}, frequency{0, 0, -1}, volume{0, 3, 0};
constexpr long double inch = 0.0254L, pound = 0.45359237L,
                      pound_force = 4.4482216152605L;  // exact by definition

constexpr std::array units{
    Unit{"m", dimension::length, 1, 0, true},
    Unit{"in", dimension::length, inch},
    Unit{"ft", dimension::length, 12 * inch},
    Unit{"g", dimension::mass, 1, -3, true},
    Unit{"t", dimension::mass, 1, 3},
    Unit{"lb", dimension::mass, pound},
    Unit{"lbm", dimension::mass, pound},
    Unit{"s", dimension::time, 1, 0, true},
    Unit{"min", dimension::time, 60},
    Unit{"h", dimension::time, 3600},
    Unit{"Hz", frequency, 1, 0, true},
    Unit{"N", dimension::force, 1, 0, true},
    Unit{"lbf", dimension::force, pound_force},
    Unit{"kip", dimension::force, 1000 * pound_force},
    Unit{"kgf", dimension::force, 9.80665L},
    Unit{"Pa", dimension::stress, 1, 0, true},
    Unit{"bar", dimension::stress, 1, 5, true},
    Unit{"atm", dimension::stress, 101325},
    Unit{"psi", dimension::stress, pound_force / (inch * inch)},
    Unit{"kpsi", dimension::stress, 1000 * pound_force / (inch * inch)},
    Unit{"ksi", dimension::stress, 1000 * pound_force / (inch * inch)},
    Unit{"Mpsi", dimension::stress, 1000000 * pound_force / (inch * inch)},
    Unit{"J", energy, 1, 0, true},
    Unit{"W", watt, 1, 0, true},
    Unit{"cc", volume, 1, -6},
    Unit{"l", volume, 1, -3, true},
    Unit{"L", volume, 1, -3, true},
    Unit{"%", dimension::number, 1, -2},
    Unit{"rad", dimension::number, 1, 0, true},
};

struct Prefix {
  std::string_view name;
  int exponent;
};
// "da" stands before "d"; micro is written "u" here, after both Greek letters have become it.
constexpr std::array prefixes{Prefix{"Q", 30},  Prefix{"R", 27},  Prefix{"Y", 24},  Prefix{"Z", 21},
                              Prefix{"E", 18},  Prefix{"P", 15},  Prefix{"T", 12},  Prefix{"G", 9},
                              Prefix{"M", 6},   Prefix{"k", 3},   Prefix{"h", 2},   Prefix{"da", 1},
                              Prefix{"d", -1},  Prefix{"c", -2},  Prefix{"m", -3},  Prefix{"u", -6},
                              Prefix{"n", -9},  Prefix{"p", -12}, Prefix{"f", -15}, Prefix{"a", -18},
                              Prefix{"z", -21}, Prefix{"y", -24}, Prefix{"r", -27}, Prefix{"q", -30}};

}  // namespace

std::optional<Unit> find_unit(std::string_view name) {
  for (const Unit& unit : units)
    if (unit.name == name) return unit;
  for (const Prefix& prefix : prefixes) {
    if (!name.starts_with(prefix.name)) continue;
    for (Unit unit : units)
      if (unit.takes_prefix && unit.name == name.substr(prefix.name.size())) {
        unit.exponent += prefix.exponent;
        return unit;
      }
  }
  return std::nullopt;
}

std::vector<std::string> unit_names(std::optional<Dimension> only) {
  std::vector<std::string> names;
  for (const Unit& unit : units) {
    if (only && !(unit.dimension == *only)) continue;
    names.emplace_back(unit.name);
    if (!unit.takes_prefix || unit.name == "bar" || unit.name == "l" || unit.name == "L") continue;
    for (const char* prefix : {"k", "M", "G", "m", "u", "c"})
      names.push_back(prefix + std::string(unit.name));
  }
  return names;
}

}  // namespace breccia
