#include "io/text/toml_depth.hpp"

#include <algorithm>
#include <string>

namespace breccia {
namespace {

/// Behind the string that begins here. One that never ends goes to the end of its line, or of the
/// text.
std::size_t behind_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const bool escapes = quote == '"', several_lines = text.substr(at, 3) == std::string(3, quote);
  const std::size_t marks = several_lines ? 3 : 1;
  for (at += marks; at < text.size(); ++at) {
    if (escapes && text[at] == '\\') {
      ++at;
    } else if (!several_lines && text[at] == '\n') {
      return at;
    } else if (text[at] == quote) {
      const std::size_t after = std::min(text.find_first_not_of(quote, at), text.size());
      // up to two quotes of its own may stand before the three that end it
      if (after - at >= marks) return several_lines ? std::min(after, at + 5) : at + 1;
      at = after - 1;
    }
  }
  return text.size();
}

}  // namespace

std::optional<std::size_t> line_nested_too_deep(std::string_view text) {
  std::size_t line = 1, brackets = 0, dots = 0;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (c == '#') {
      at = std::min(text.find('\n', at), text.size());
      continue;
    }
    if (c == '"' || c == '\'') {
      const std::size_t behind = behind_string(text, at);
      line += static_cast<std::size_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(at),
                                                  text.begin() + static_cast<std::ptrdiff_t>(behind), '\n'));
      at = behind;
      continue;
    }
    if (c == '.')
      ++dots;
    else if (c == '\n' || c == '=' || c == ',' || c == '[' || c == ']' || c == '{' || c == '}')
      dots = 0;
    if (c == '[' || c == '{') ++brackets;
    if ((c == ']' || c == '}') && brackets > 0) --brackets;
    if (dots >= deepest_toml || brackets > deepest_toml) return line;
    if (c == '\n') ++line;
    ++at;
  }
  return std::nullopt;
}

}  // namespace breccia
