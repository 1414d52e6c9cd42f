// How deep a TOML text is nested, seen before anything is built of it: what reads and frees a tree
// goes down into it by recursion, and the stack has an end.
#pragma once
#include <cstddef>
#include <optional>
#include <string_view>

namespace breccia {

/// Parts of a dotted key, and brackets within brackets, that a text may have; the keys of a case
/// need four.
inline constexpr std::size_t deepest_toml = 32;

/// The line, from 1, in which a text is nested deeper than that; nothing where it is not.
std::optional<std::size_t> line_nested_too_deep(std::string_view text);

}  // namespace breccia
