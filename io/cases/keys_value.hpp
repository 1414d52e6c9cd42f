// One value of a case: read and checked against the declaration of its key, and written again.
#pragma once
#include <string>

#include "io/cases/keys_schema.hpp"
#include "io/text/toml_node.hpp"

namespace breccia {

/// Ends with one line: place, key, what is wrong and the cure.
/// @throws BadInput always
[[noreturn]] void refuse(const std::string& place, std::string_view key, const std::string& text);

/// Reads a value, checking type, dimension, range and choice.
/// @throws BadInput with the node's place and the key
Reading read_value(const Key&, const TomlNode&);

/// Refuses numbers of a reading that lie outside a range.
void check_range(const Key&, const Reading&, const Range&, const std::string& place,
                 const std::string& where);

/// A value written as a default is, for instance by a law.
Reading read_default_text(const Key&, std::string_view text);

/// The default of a key for a test in the solid or in the plane; the key must have one.
Reading read_default(const Key&, std::string_view test, Space space = Space::three_d);

/// The value as TOML with a readable unit; reads back to the same value.
std::string write_value(const Key&, const Reading&);

}  // namespace breccia
