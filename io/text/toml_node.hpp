// A TOML file as plain data, each value with its place. Only toml_node.cpp knows the library that
// parses.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace breccia {

struct TomlNode;
struct TomlEntry;
using TomlArray = std::vector<TomlNode>;
using TomlTable = std::vector<TomlEntry>;  ///< in the order of the file
struct TomlDate {};                        ///< no key is a date

struct TomlNode {
  std::variant<bool, std::int64_t, double, std::string, TomlDate, TomlArray, TomlTable> value;
  std::string place;  ///< "file:line", or "--set"
  std::size_t line = 0;
};

struct TomlEntry {
  std::string name;
  TomlNode node;
};

/// Reads a TOML file.
/// @throws BadInput: file (and line) with what is wrong: absent, no file, nested too deep, not TOML
TomlNode read_toml(const std::filesystem::path& file);

/// Parses what stands behind "key=" on a command line: a TOML value, or the text itself as a string
/// where it is none.
TomlNode parse_toml_value(const std::string& text, const std::string& place);

/// A text as a TOML string in double quotes, escaped.
std::string toml_string(const std::string& text);

}  // namespace breccia
