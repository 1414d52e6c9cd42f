#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <string>

#include "core/base/error.hpp"
#include "io/text/suggest.hpp"
#include "io/text/units.hpp"

using namespace breccia;

namespace {

struct Row {
  const char* text;
  Dimension dimension;
  double si;
};

std::string complaint(const char* text, Dimension wanted) {
  try {
    parse_quantity(text, wanted);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "accepted";
}

void says(const std::string& text, const std::string& part) {
  INFO(text);
  CHECK(text.find(part) != std::string::npos);
}

}  // namespace

TEST_CASE("units: decimal multiples of SI read as the bare number does, bit for bit") {
  using namespace dimension;
  const Row rows[] = {
      {"28 GPa", stress, 28e9},
      {"3.8GPa", stress, 3.8e9},
      {"0.34 MPa", stress, 0.34e6},
      {"1 Pa", stress, 1},
      {"-2.5 kPa", stress, -2500},
      {"7 hPa", stress, 700},
      {"1 bar", stress, 1e5},
      {"20 mbar", stress, 2000},
      {"5 N/mm^2", stress, 5e6},
      {"150 mm", length, 0.150},
      {"38.1 mm", length, 0.0381},
      {"48.26 mm", length, 0.04826},
      {"2 cm", length, 0.02},
      {"12 um", length, 12e-6},
      {"12 \u00b5m", length, 12e-6},
      {"12 \u03bcm", length, 12e-6},
      {"3 nm", length, 3e-9},
      {"1e3 mm", length, 1},
      {"2500 kg/m^3", density, 2500},
      {"2500 kg/m3", density, 2500},
      {"2500 kg/m\u00b3", density, 2500},
      {"1.70 g/cm3", density, 1700},
      {"1.7 g/cc", density, 1700},
      {"2.4 t/m^3", density, 2400},
      {"0.1 m/s", speed, 0.1},
      {"100 mm / s", speed, 0.1},
      {"1 m*s^-1", speed, 1},
      {"4 J/m^2", energy_per_area, 4},
      {"0.1 kJ/m2", energy_per_area, 100},
      {"5 N/m", energy_per_area, 5},
      {"5 min", dimension::time, 300},
      {"2 h", dimension::time, 7200},
      {"3 ms", dimension::time, 0.003},
      {"10 kN", force, 1e4},
      {"2 kg", mass, 2},
      {"1 Mg", mass, 1000},
      {"18 %", number, 0.18},
      {"18%", number, 0.18},
      {"0.2", number, 0.2},
      {"+3 mm/m", number, 0.003},
      {"2e-3", number, 0.002},
      {"1 kg*m/s^2", force, 1},
  };
  for (const Row& row : rows) {
    INFO(row.text);
    CHECK(parse_quantity(row.text, row.dimension) == row.si);
  }
}

TEST_CASE("units: inch and pound units by their exact definitions") {
  using namespace dimension;
  const Row rows[] = {
      {"1 in", length, 0.0254},
      {"1.487 in", length, 0.0377698},
      {"2 ft", length, 0.6096},
      {"1 lb", mass, 0.45359237},
      {"847 lbf", force, 847 * 4.4482216152605},
      {"1 kip", force, 4448.2216152605},
      {"1000 psi", stress, 6894757.293168361},
      {"1 ksi", stress, 6894757.293168361},
      {"1 Mpsi", stress, 6894757293.168361},
      {"1 lbf/in^2", stress, 6894.757293168361},
      {"1 atm", stress, 101325},
      {"150 lb/ft^3", density, 150 * 0.45359237 / (0.3048 * 0.3048 * 0.3048)},
  };
  for (const Row& row : rows) {
    INFO(row.text);
    CHECK(parse_quantity(row.text, row.dimension) == doctest::Approx(row.si).epsilon(1e-15));
  }
}

TEST_CASE("units: a unit alone has a dimension") {
  CHECK(dimension_of("N/m") == dimension::energy_per_area);
  CHECK(dimension_of("kN/mm^2") == dimension::stress);
  CHECK(dimension_of("1") == dimension::number);
  CHECK_THROWS_AS(dimension_of("stone"), BadInput);
}

TEST_CASE("units: what is wrong is named, with the nearest unit or an example") {
  using namespace dimension;
  says(complaint("30 Mpa", stress), "unknown unit \"Mpa\"; did you mean \"MPa\"?");
  says(complaint("30 GPA", stress), "did you mean \"GPa\"?");
  says(complaint("30 spi", stress), "did you mean \"psi\"?");
  says(complaint("3 inch", length), "did you mean \"in\"?");
  says(complaint("3 kg/M^3", density), "unknown unit \"M\"; did you mean \"m\"?");
  says(complaint("3 furlongs", length), "unknown unit \"furlongs\"; a length is wanted, in SI \"m\"");
  says(complaint("5 mm", stress), "\"5 mm\" is a length; a stress is wanted, such as \"5 MPa\"");
  says(complaint("5 kg*m", stress), "is a quantity in kg*m; a stress is wanted");
  says(complaint("5 mm", number), "a number is wanted, without a unit or in \"%\"");
  says(complaint("28", stress), "\"28\" has no unit; write \"28 MPa\", or the bare number 28 for SI (Pa)");
  says(complaint("MPa", stress), "\"MPa\" does not begin with a number");
  says(complaint("", stress), "does not begin with a number");
  says(complaint("3,8 GPa", stress), "decimals stand behind a point, not a comma");
  says(complaint("inf Pa", stress), "is not a finite number");
  says(complaint("nan", number), "is not a finite number");
  says(complaint("1e999 Pa", stress), "is not a finite number");
  says(complaint("1e305 GPa", stress), "is not a finite number");
  says(complaint("5 kg m^-3", density), "is not a unit; write it like \"kg/m^3\"");
  says(complaint("5 kg//m", density), "is not a unit");
  says(complaint("5 m^", length), "a power is a whole number");
  says(complaint("5 m^0", length), "a power is a whole number");
  says(complaint("5 (m)", length), "is not a unit");
}

TEST_CASE("units: a value is written readably and reads back to the identical double") {
  using namespace dimension;
  CHECK(format_quantity(28e9, stress) == "28 GPa");
  CHECK(format_quantity(4.5e6, stress) == "4.5 MPa");
  CHECK(format_quantity(0, stress) == "0 Pa");
  CHECK(format_quantity(-20, stress) == "-20 Pa");
  CHECK(format_quantity(0.15, length) == "150 mm");
  CHECK(format_quantity(0.04826, length) == "48.26 mm");
  CHECK(format_quantity(1e-5, length) == "10 um");
  CHECK(format_quantity(2500, density) == "2500 kg/m^3");
  CHECK(format_quantity(0.1, speed) == "0.1 m/s");
  CHECK(format_quantity(4, energy_per_area) == "4 J/m^2");
  CHECK(format_quantity(0.02, number) == "0.02");
  CHECK(format_quantity(1, {1, 2, 0}) == "1 kg*m^2");
  CHECK(format_quantity(parse_quantity("500 psi", stress), stress) == "500 psi");
  CHECK(format_quantity(1.0 / 3, stress) == "0.3333333333333333 Pa");
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-30, 30), mantissa(-10, 10);
  for (int i = 0; i < 20000; ++i) {
    const double value = mantissa(random) * std::pow(10, exponent(random));
    for (const Dimension d :
         {stress, length, density, speed, dimension::time, number, energy_per_area, Dimension{1, 2, -3}}) {
      const std::string text = format_quantity(value, d);
      INFO(text);
      REQUIRE(parse_quantity(text, d) == value);
    }
  }
}

TEST_CASE("nearest: the word that differs least, none when all are far") {
  CHECK(edit_distance("kitten", "sitting") == 3);
  CHECK(edit_distance("range", "rnage") == 1);
  CHECK(edit_distance("", "abc") == 3);
  CHECK(nearest("porosty", {"affine", "porosity"}) == "porosity");
  CHECK(nearest("xyz", {"affine", "porosity"}).empty());
  CHECK(suggest("xyz", {"affine", "porosity"}) == "valid: \"affine\", \"porosity\"");
}
