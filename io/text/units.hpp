// Quantities with units: "1000 psi", "3.8 GPa", "4 J/m^2", read into SI and written so that they
// read back the same.
#pragma once
#include <string>
#include <string_view>

namespace breccia {

/// Exponents of kilogram, metre and second.
struct Dimension {
  int kg = 0, m = 0, s = 0;
  constexpr bool operator==(const Dimension&) const = default;
};

namespace dimension {
inline constexpr Dimension number{}, mass{1, 0, 0}, length{0, 1, 0}, time{0, 0, 1}, speed{0, 1, -1},
    force{1, 1, -2}, stress{1, -1, -2}, density{1, -3, 0},
    energy_per_area{1, 0, -2};  // of a stiffness, N/m, too
}

/// What a dimension is called: "a length", "a stress"; base units where it has no name: "kg*m^2".
std::string describe(Dimension);

/// The SI unit in which a bare number of that dimension is read: "Pa", "kg/m^3"; empty for a
/// number.
std::string si_unit(Dimension);

/// The dimension of a unit: of "N/m^2" a stress, of "1" a number.
/// @throws BadInput where it is none
Dimension dimension_of(std::string_view unit);

/// Reads a number with its unit: SI with every prefix, in, ft, lb, lbf, kip, psi, ksi, bar, atm, t,
/// min, h, %, ..., joined with * / ^ ("kg/m^3", "N*s/m", "g/cm3"). A decimal multiple of SI reads
/// as the same double as the bare number would: "38.1 mm" is 0.0381.
/// @return the value in SI
/// @throws BadInput without a place: what is wrong with the text, and the nearest valid unit
double parse_quantity(std::string_view text, Dimension wanted);

/// A value in SI with a readable unit, "28 GPa" or "150 mm"; a number without one. Reads back to
/// the identical double.
std::string format_quantity(double si, Dimension);

}  // namespace breccia
