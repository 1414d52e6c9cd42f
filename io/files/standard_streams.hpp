// Where a program speaks: standard output, standard error.
#pragma once
#include <string_view>

namespace breccia {

/// A program may be started with some of its three streams closed. The next file that it opened
/// would take the number of one, and be written into by every message: the empty device takes these
/// numbers first.
void open_standard_streams();

/// Writes to the standard output and hands it to the system.
/// @throws WriteError: nobody reads it any more, its disk is full, ...
void print_out(std::string_view text);

}  // namespace breccia
