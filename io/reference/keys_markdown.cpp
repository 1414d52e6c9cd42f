#include "io/reference/keys_markdown.hpp"

#include <fmt/format.h>

namespace breccia {
namespace {

/// A cell of a table in markdown: no star begins an emphasis, no bar ends the cell.
std::string cell(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '*' || c == '|') result += '\\';
    result += c;
  }
  return result;
}

}  // namespace

std::string_view table_of(const Key& key) { return key.name.substr(0, key.name.rfind('.')); }
std::string_view word_of(const Key& key) { return key.name.substr(key.name.rfind('.') + 1); }

std::string code(std::string_view text) { return fmt::format("`{}`", text); }

void add_row(std::string& text, std::string_view name, std::string_view valid, std::string_view default_text,
             std::string_view who, std::string_view meaning) {
  text += fmt::format("| {} | {} | {} | {} | {} |\n", code(name), cell(valid), cell(default_text), who,
                      cell(meaning));
}

void add_heading(std::string& text, std::string_view table, std::string_view who) {
  text +=
      fmt::format("\n### {}\n\n| key | valid | default | {} | meaning |\n| --- | --- | --- | --- | --- |\n",
                  code(table), who);
}

}  // namespace breccia
