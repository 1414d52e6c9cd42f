#include "io/cases/keys_value.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "io/text/suggest.hpp"

namespace breccia {
namespace {

std::string shown(const TomlNode& node) {
  if (const auto* flag = std::get_if<bool>(&node.value)) return *flag ? "true" : "false";
  if (const auto* whole = std::get_if<std::int64_t>(&node.value)) return fmt::format("{}", *whole);
  if (const auto* real = std::get_if<double>(&node.value)) return fmt::format("{}", *real);
  if (const auto* text = std::get_if<std::string>(&node.value)) return quote(*text);
  if (std::holds_alternative<TomlArray>(node.value)) return "an array";
  return std::holds_alternative<TomlTable>(node.value) ? "a table" : "a date";
}

std::string wanted_quantity(const Key& key) {
  if (key.dimension == dimension::number) return "a number is wanted";
  return fmt::format("{} is wanted, a string with its unit or a bare number in {}", describe(key.dimension),
                     si_unit(key.dimension));
}

void check_range(const Key& key, const Range& r, double value, const std::string& place, Dimension d,
                 const std::string& where = {}) {
  const bool below = r.low_open ? value <= r.low : value < r.low;
  const bool above = r.high_open ? value >= r.high : value > r.high;
  if (below || above)
    refuse(place, key.name,
           fmt::format("must be {}{}, not {}", describe(r, d), where, format_quantity(value, d)));
}

double read_quantity(const Key& key, const TomlNode& node) {
  double value = 0;
  if (const auto* whole = std::get_if<std::int64_t>(&node.value)) {
    value = static_cast<double>(*whole);
  } else if (const auto* real = std::get_if<double>(&node.value)) {
    value = *real;
  } else if (const auto* text = std::get_if<std::string>(&node.value)) {
    try {
      value = parse_quantity(*text, key.dimension);
    } catch (const BadInput& error) {
      refuse(node.place, key.name, error.what());
    }
  } else {
    refuse(node.place, key.name, fmt::format("{}, not {}", wanted_quantity(key), shown(node)));
  }
  if (!std::isfinite(value)) refuse(node.place, key.name, shown(node) + " is not a finite number");
  check_range(key, key.range, value, node.place, key.dimension);
  return value;
}

std::vector<double> read_quantities(const Key& key, const TomlNode& node) {
  const auto* array = std::get_if<TomlArray>(&node.value);
  std::vector<double> values;
  if (array)
    for (const TomlNode& entry : *array) values.push_back(read_quantity(key, entry));
  else if (key.count == 0)
    values.push_back(read_quantity(key, node));  // a list of one, as --set gives it
  if (key.count > 0 && values.size() != key.count)
    refuse(node.place, key.name,
           fmt::format("{} values are wanted, [a, b, c]; {} given", key.count, array ? values.size() : 1));
  if (values.empty()) refuse(node.place, key.name, "the list is empty; give one value or more");
  if (key.rising)
    for (std::size_t i = 1; i < values.size(); ++i)
      if (values[i] < values[i - 1])
        refuse(node.place, key.name,
               fmt::format("must rise: {} stands behind {}", format_quantity(values[i], key.dimension),
                           format_quantity(values[i - 1], key.dimension)));
  return values;
}

std::int64_t read_whole(const Key& key, const TomlNode& node) {
  constexpr double largest = 9007199254740992.0;  // 2^53: a float is a whole number up to here
  std::int64_t value = 0;
  if (const auto* whole = std::get_if<std::int64_t>(&node.value))
    value = *whole;
  else if (const auto* real = std::get_if<double>(&node.value);
           real && std::abs(*real) <= largest && std::floor(*real) == *real)
    value = static_cast<std::int64_t>(*real);
  else
    refuse(node.place, key.name, "a whole number is wanted, not " + shown(node));
  check_range(key, key.range, static_cast<double>(value), node.place, dimension::number);
  return value;
}

bool contains(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

std::string read_word(const Key& key, const TomlNode& node) {
  const auto words = split_words(key.words);
  const auto* word = std::get_if<std::string>(&node.value);
  if (!word)
    refuse(node.place, key.name,
           fmt::format("a word is wanted, not {}; valid: {}", shown(node), quote_list(words)));
  if (contains(words, *word)) return *word;
  const std::string number = key.kind == Kind::word_or_number ? ", or a number" : "";
  refuse(node.place, key.name, fmt::format("unknown {}; {}{}", quote(*word), suggest(*word, words), number));
}

}  // namespace

void refuse(const std::string& place, std::string_view key, const std::string& text) {
  std::string line = fmt::format("{}: {}: {}", place, key, text);
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; },
      ' ');  // a quoted key may hold any
  throw BadInput(line);
}

void check_range(const Key& key, const Reading& reading, const Range& range, const std::string& place,
                 const std::string& where) {
  check_range(key, range, reading.number, place, key.dimension, where);
}

Reading read_value(const Key& key, const TomlNode& node) {
  Reading reading;
  switch (key.kind) {
    case Kind::quantity:
      reading.number = read_quantity(key, node);
      break;
    case Kind::quantities:
      reading.numbers = read_quantities(key, node);
      break;
    case Kind::whole_number:
      reading.whole = read_whole(key, node);
      break;
    case Kind::word:
      reading.word = read_word(key, node);
      break;
    case Kind::word_or_number:
      if (std::holds_alternative<std::string>(node.value))
        reading.word = read_word(key, node);
      else
        reading.number = read_quantity(key, node);
      break;
    case Kind::text: {
      const auto* text = std::get_if<std::string>(&node.value);
      if (!text || text->empty()) refuse(node.place, key.name, "a string is wanted, not " + shown(node));
      reading.word = *text;
      break;
    }
    case Kind::boolean: {
      const auto* flag = std::get_if<bool>(&node.value);
      if (!flag) refuse(node.place, key.name, "true or false is wanted, not " + shown(node));
      reading.flag = *flag;
      break;
    }
  }
  return reading;
}

Reading read_default(const Key& key, std::string_view test, Space space) {
  return read_default_text(key, default_text_of(key, test, space));
}

Reading read_default_text(const Key& key, std::string_view default_text) {
  const std::string text(default_text);
  TomlNode node{text, "default", 0};
  if (key.kind == Kind::boolean) node.value = text == "true";
  if (key.kind == Kind::word_or_number && text.find_first_not_of("0123456789.") == std::string::npos)
    node.value = std::stod(text);
  if (key.kind == Kind::whole_number) node.value = std::int64_t{std::stoll(text)};
  if (key.kind == Kind::word_or_number && !contains(split_words(key.words), text))
    node.value = std::stod(text);
  return read_value(key, node);
}

std::string write_value(const Key& key, const Reading& reading) {
  const auto quantity = [&](double value) {
    const std::string text = format_quantity(value, key.dimension);
    return key.dimension == dimension::number ? text : toml_string(text);
  };
  switch (key.kind) {
    case Kind::quantity:
      return quantity(reading.number);
    case Kind::whole_number:
      return fmt::format("{}", reading.whole);
    case Kind::boolean:
      return reading.flag ? "true" : "false";
    case Kind::word:
    case Kind::text:
      return toml_string(reading.word);
    case Kind::word_or_number:
      return reading.word.empty() ? quantity(reading.number) : toml_string(reading.word);
    case Kind::quantities:
      break;
  }
  std::string list;
  for (double value : reading.numbers) list += (list.empty() ? "" : ", ") + quantity(value);
  return "[" + list + "]";
}

}  // namespace breccia
