#include "io/impact_cases/impact_reference.hpp"

#include <fmt/format.h>

#include "io/cases/keys_write.hpp"
#include "io/impact_cases/impact_keys.hpp"
#include "io/reference/keys_markdown.hpp"

namespace breccia {
namespace {

template <class T>
void add_fields(std::string& text, std::span<const Field<T>> fields, std::string_view left,
                std::string_view right) {
  std::string_view table;
  for (const Field<T>& field : fields) {
    const Key& key = field.key;
    if (table_of(key) != table) {
      table = table_of(key);
      add_heading(text, fmt::format("{}{}{}", left, table, right), "of");
    }
    const std::string default_text = field.required             ? "none: must be given"
                                     : key.default_text.empty() ? "none"
                                                                : code(key.default_text);
    add_row(text, word_of(key), describe_values(key), default_text, field.kinds.empty() ? "all" : field.kinds,
            key.meaning);
  }
}

}  // namespace

std::string impact_reference() {
  std::string text;
  add_fields(text, scene_fields(), "[", "]");
  add_fields(text, material_fields(), "[", ".NAME]");
  add_fields(text, particle_fields(), "[[", "]]");
  add_fields(text, spheres_fields(), "[", "]");
  add_fields(text, wall_fields(), "[[", "]]");
  return text;
}

}  // namespace breccia
