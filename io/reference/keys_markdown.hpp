// Tables of keys in markdown, a row for each.
#pragma once
#include <string>
#include <string_view>

#include "io/cases/keys_schema.hpp"

namespace breccia {

/// "test" and "platens" of "test.platens".
std::string_view table_of(const Key& key);
std::string_view word_of(const Key& key);

/// A word as code.
std::string code(std::string_view text);

void add_row(std::string& text, std::string_view name, std::string_view valid, std::string_view default_text,
             std::string_view who, std::string_view meaning);

/// The head of a table.
/// @param who  over the column of what takes a key: "programs", "laws"
void add_heading(std::string& text, std::string_view table, std::string_view who);

}  // namespace breccia
