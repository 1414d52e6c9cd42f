#include "io/text/units.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <system_error>
#include <vector>

#include "core/base/error.hpp"
#include "io/text/suggest.hpp"
#include "io/text/unit_table.hpp"

namespace breccia {
namespace {

struct Scale {
  Dimension dimension;
  long double factor = 1;
  int exponent = 0;
};

std::string in_ascii(std::string_view text) {
  std::string result(text);
  for (const auto& [from, to] :
       {std::pair{"\u00b2", "^2"}, {"\u00b3", "^3"}, {"\u00b7", "*"}, {"\u00b5", "u"}, {"\u03bc", "u"}})
    for (std::size_t at; (at = result.find(from)) != std::string::npos;)
      result.replace(at, std::string_view(from).size(), to);
  return result;
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '%'; }

void skip_blanks(std::string_view& text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
}

[[noreturn]] void refuse_unit(std::string_view name, std::string_view whole, Dimension wanted) {
  const bool alone = whole == name;  // part of a compound may be anything
  std::string best = alone ? nearest(name, unit_names(wanted)) : "";
  if (best.empty()) best = nearest(name, unit_names(std::nullopt));
  if (!best.empty()) fail<BadInput>("unknown unit {}; did you mean {}?", quote(name), quote(best));
  fail<BadInput>("unknown unit {}; {} is wanted, in SI {}", quote(name), describe(wanted),
                 quote(si_unit(wanted)));
}

int parse_power(std::string_view& rest, std::string_view whole) {
  skip_blanks(rest);
  const bool caret = !rest.empty() && rest.front() == '^';
  if (caret) rest.remove_prefix(1);
  int power = 1;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), power);
  const bool given = error == std::errc{} && (caret || rest.front() != '-');
  if ((caret && !given) || (given && (power == 0 || std::abs(power) > 9)))
    fail<BadInput>("{} is not a unit: a power is a whole number from 1 to 9", quote(whole));
  if (!given) return 1;
  rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
  return power;
}

/// unit := power { ("*" | "/") power }, power := name [ [^] number ]; a slash divides by the next
/// name only.
Scale parse_unit(std::string_view whole, Dimension wanted) {
  const std::string ascii = in_ascii(whole);
  std::string_view rest = ascii;
  Scale scale;
  int sign = 1;
  for (;;) {
    skip_blanks(rest);
    std::size_t length = 0;
    while (length < rest.size() && is_letter(rest[length])) ++length;
    if (length == 0) fail<BadInput>("{} is not a unit; write it like \"kg/m^3\" or \"N*s/m\"", quote(whole));
    const std::string_view name = rest.substr(0, length);
    const auto unit = find_unit(name);
    if (!unit) refuse_unit(name, ascii, wanted);
    rest.remove_prefix(length);
    const int power = sign * parse_power(rest, whole);
    scale.dimension.kg += power * unit->dimension.kg;
    scale.dimension.m += power * unit->dimension.m;
    scale.dimension.s += power * unit->dimension.s;
    scale.exponent += power * unit->exponent;
    for (int i = 0; i < std::abs(power); ++i)
      scale.factor = power > 0 ? scale.factor * unit->factor : scale.factor / unit->factor;
    skip_blanks(rest);
    if (rest.empty()) return scale;
    if (rest.front() != '*' && rest.front() != '/')
      fail<BadInput>("{} is not a unit; write it like \"kg/m^3\" or \"N*s/m\"", quote(whole));
    sign = rest.front() == '*' ? 1 : -1;
    rest.remove_prefix(1);
  }
}

/// The number in `digits` ("38.1", "2e3") times 10^shift, rounded once.
double shifted(std::string_view digits, int shift) {
  const std::size_t e = digits.find_first_of("eE");
  int exponent = 0;
  if (e != std::string_view::npos) {
    const std::size_t first = e + 1 + (digits[e + 1] == '+' ? 1 : 0);
    std::from_chars(digits.data() + first, digits.data() + digits.size(), exponent);
    // "0e2147483647" is a zero too: beyond a thousand, all that is not zero is infinite or nothing
    exponent = std::clamp(exponent, -1000, 1000);
  }
  const std::string text = fmt::format("{}e{}", digits.substr(0, e), exponent + shift);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} ? value : HUGE_VAL;
}

std::string example(std::string_view number, Dimension wanted) {
  return quote(std::string(number) + " " + (wanted == dimension::stress ? "MPa" : si_unit(wanted)));
}

/// In these units results are written, the largest first; a value takes the first that it reaches.
struct Shown {
  Dimension dimension;
  std::string_view unit;
  int exponent;
};
constexpr std::array shown{Shown{dimension::stress, "GPa", 9},
                           Shown{dimension::stress, "MPa", 6},
                           Shown{dimension::stress, "kPa", 3},
                           Shown{dimension::stress, "Pa", 0},
                           Shown{dimension::length, "m", 0},
                           Shown{dimension::length, "mm", -3},
                           Shown{dimension::length, "um", -6},
                           Shown{dimension::time, "s", 0},
                           Shown{dimension::time, "ms", -3},
                           Shown{dimension::time, "us", -6},
                           Shown{dimension::speed, "m/s", 0},
                           Shown{dimension::density, "kg/m^3", 0},
                           Shown{dimension::energy_per_area, "J/m^2", 0},
                           Shown{dimension::mass, "kg", 0},
                           Shown{dimension::force, "N", 0}};

/// Shortest digits of a double with the decimal point moved: the value is digits x 10^(exponent + 1
/// - digits.size()).
std::string decimal(const std::string& digits, int exponent) {
  const int point = exponent + 1, length = static_cast<int>(digits.size());
  if (point > 18 || point < -5) {
    return fmt::format("{}{}{}e{}", digits[0], length > 1 ? "." : "", digits.substr(1), exponent);
  }
  if (point <= 0) return fmt::format("0.{:0>{}}", digits, length - point);
  if (point >= length) return fmt::format("{:0<{}}", digits, point);
  return fmt::format("{}.{}", digits.substr(0, static_cast<std::size_t>(point)),
                     digits.substr(static_cast<std::size_t>(point)));
}

/// "500 psi" rather than its 17 digits in MPa: what was given in inches or pounds is shown so, if
/// that is exact.
std::string in_pounds(double si, Dimension d) {
  for (const char* name : {"psi", "in", "lb/ft^3", "lb", "lbf"}) {
    const Scale scale = parse_unit(name, d);
    if (!(scale.dimension == d)) continue;
    std::string text =
        fmt::format("{:.7g} {}", static_cast<double>(static_cast<long double>(si) / scale.factor), name);
    if (parse_quantity(text, d) == si) return text;
  }
  return "";
}

}  // namespace

std::string si_unit(Dimension d) {
  if (d == dimension::number) return "";
  for (const Shown& s : shown)
    if (s.dimension == d && s.exponent == 0) return std::string(s.unit);
  std::string text;
  for (const auto& [name, power] : {std::pair{"kg", d.kg}, {"m", d.m}, {"s", d.s}})
    if (power != 0)
      text +=
          fmt::format("{}{}{}", text.empty() ? "" : "*", name, power == 1 ? "" : fmt::format("^{}", power));
  return text;
}

std::string describe(Dimension d) {
  if (d == dimension::number) return "a number";
  if (d == dimension::mass) return "a mass";
  if (d == dimension::length) return "a length";
  if (d == dimension::time) return "a time";
  if (d == dimension::speed) return "a speed";
  if (d == dimension::force) return "a force";
  if (d == dimension::stress) return "a stress";
  if (d == dimension::density) return "a density";
  if (d == dimension::energy_per_area) return "an energy per area or a stiffness";
  return "a quantity in " + si_unit(d);
}

Dimension dimension_of(std::string_view unit) {
  return unit == "1" ? dimension::number : parse_unit(unit, dimension::number).dimension;
}

double parse_quantity(std::string_view text, Dimension wanted) {
  std::string_view rest = text;
  skip_blanks(rest);
  while (!rest.empty() && (rest.back() == ' ' || rest.back() == '\t')) rest.remove_suffix(1);
  if (rest.starts_with("+")) rest.remove_prefix(1);
  double plain = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), plain);
  if (error == std::errc::invalid_argument)
    fail<BadInput>("{} does not begin with a number; write {}", quote(text), example("1.5", wanted));
  if (error != std::errc{} || !std::isfinite(plain)) fail<BadInput>("{} is not a finite number", quote(text));
  const std::string_view digits = rest.substr(0, static_cast<std::size_t>(end - rest.data()));
  rest.remove_prefix(digits.size());
  if (rest.starts_with(",")) fail<BadInput>("{}: decimals stand behind a point, not a comma", quote(text));
  skip_blanks(rest);
  if (rest.empty()) {
    if (wanted == dimension::number) return plain;
    fail<BadInput>("{} has no unit; write {}, or the bare number {} for SI ({})", quote(text),
                   example(digits, wanted), digits, si_unit(wanted));
  }
  const Scale scale = parse_unit(rest, wanted);
  if (!(scale.dimension == wanted)) {
    const std::string cure =
        wanted == dimension::number ? "without a unit or in \"%\"" : "such as " + example(digits, wanted);
    fail<BadInput>("{} is {}; {} is wanted, {}", quote(text), describe(scale.dimension), describe(wanted),
                   cure);
  }
  const double value = scale.factor == 1
                           ? shifted(digits, scale.exponent)
                           : static_cast<double>(plain * scale.factor * std::pow(10.0L, scale.exponent));
  if (!std::isfinite(value)) fail<BadInput>("{} is not a finite number in SI", quote(text));
  return value;
}

std::string format_quantity(double si, Dimension d) {
  std::array<char, 32> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), std::abs(si),
                                          std::chars_format::scientific);
  const std::string_view text(buffer.data(), end);
  const std::size_t e = text.find('e');
  if (e == std::string_view::npos) return fmt::format("{}", si);  // not finite: nothing to scale
  std::string digits(text.substr(0, 1));
  if (e > 2) digits += text.substr(2, e - 2);
  constexpr std::size_t many = 10;
  if (digits.size() > many)
    if (const std::string pounds = in_pounds(si, d); !pounds.empty()) return pounds;
  const int exponent = std::atoi(std::string(text.substr(e + 1)).c_str());
  int shift = 0;
  std::string unit = si_unit(d);
  for (const Shown& s : shown) {
    if (!(s.dimension == d) || si == 0) continue;
    shift = s.exponent, unit = s.unit;
    if (exponent >= s.exponent) break;
  }
  return fmt::format("{}{}{}{}", std::signbit(si) ? "-" : "", decimal(digits, exponent - shift),
                     unit.empty() ? "" : " ", unit);
}

}  // namespace breccia
