#include "io/text/toml_node.hpp"

#include <toml++/toml.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "io/text/input_file.hpp"
#include "io/text/suggest.hpp"
#include "io/text/text_file.hpp"
#include "io/text/toml_depth.hpp"

namespace breccia {
namespace {

struct Converter {
  std::string file;
  bool lines;

  std::string place(std::size_t line) const {
    return lines && line > 0 ? fmt::format("{}:{}", file, line) : file;
  }

  TomlNode convert(const toml::node& node, std::size_t line) const {
    TomlNode result{TomlDate{}, place(line), line};
    if (const auto* table = node.as_table()) {
      TomlTable entries;
      for (const auto& [key, child] : *table)
        entries.push_back({std::string(key.str()), convert(child, key.source().begin.line)});
      std::stable_sort(entries.begin(), entries.end(),
                       [](const auto& a, const auto& b) { return a.node.line < b.node.line; });
      result.value = std::move(entries);
    } else if (const auto* array = node.as_array()) {
      TomlArray entries;
      for (const auto& child : *array) entries.push_back(convert(child, child.source().begin.line));
      result.value = std::move(entries);
    } else if (const auto* text = node.as_string()) {
      result.value = text->get();
    } else if (const auto* whole = node.as_integer()) {
      result.value = whole->get();
    } else if (const auto* real = node.as_floating_point()) {
      result.value = real->get();
    } else if (const auto* flag = node.as_boolean()) {
      result.value = flag->get();
    }
    return result;
  }
};

std::string one_line(std::string_view text) {
  std::string result(text);
  std::replace(result.begin(), result.end(), '\n', ' ');
  return result;
}

std::string nearest_file(const std::filesystem::path& file) {
  const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  const std::string best = nearest(file.filename().string(), names_in(folder, ".toml"));
  return best.empty() ? "" : "; did you mean " + quote(best) + "?";
}

}  // namespace

TomlNode read_toml(const std::filesystem::path& file) {
  const std::string name = file.string();
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) fail<BadInput>("{}: no such file{}", name, nearest_file(file));
  const std::string text = read_bytes(file);
  if (const auto line = line_nested_too_deep(text))
    fail<BadInput>("{}:{}: nested more than {} deep; the keys of a case are table.key", name, *line,
                   deepest_toml);
  try {
    const toml::table table = toml::parse(text, name);
    return Converter{name, true}.convert(table, 0);
  } catch (const toml::parse_error& error) {
    fail<BadInput>("{}:{}: not TOML: {}", name, error.source().begin.line, one_line(error.description()));
  }
}

TomlNode parse_toml_value(const std::string& text, const std::string& place) {
  const Converter converter{place, false};
  if (text.find('\n') == std::string::npos && !line_nested_too_deep(text)) {
    try {
      const toml::table table = toml::parse("value = " + text, std::string(place));
      if (table.size() == 1) return converter.convert(*table.get("value"), 0);
    } catch (const toml::parse_error&) {
      // a bare word or a quantity without quotes, as one writes it in a shell
    }
  }
  return {std::string(trim(text)), place, 0};
}

std::string toml_string(const std::string& text) {
  std::string result = "\"";
  for (char c : text) {
    if (c == '"' || c == '\\')
      result += '\\', result += c;
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      result += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
    else
      result += c;
  }
  return result + "\"";
}

}  // namespace breccia
