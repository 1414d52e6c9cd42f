// A message as one line that a terminal and a reader can take, whatever stood in the input that it
// speaks of.
#pragma once
#include <string>
#include <string_view>

namespace breccia {

/// At most `longest` bytes of a text, "..." behind it where something is left out; cut between
/// words where there is a blank in the second half, never within a character of UTF-8.
std::string shortened(std::string_view text, std::size_t longest);

/// Bytes that are no UTF-8 as \xff.
std::string printable(std::string_view text);

/// True for a text that is UTF-8, as a TOML file must be.
bool is_utf8(std::string_view text);

/// Blanks for what would break the line or steer a terminal, \xff for what is no UTF-8, and words
/// of more than 300 bytes shortened in their middle: a path is known by its end.
std::string message_line(std::string_view text);

}  // namespace breccia
