// One line for any file that cannot be written: which file, why, and what to do about it.
#pragma once
#include <filesystem>
#include <string_view>

namespace breccia {

/// @param file   the file or folder that could not be written
/// @param error  errno as the system left it
/// @throws WriteError, always
[[noreturn]] void fail_to_write(const std::filesystem::path& file, int error);

/// The same when the cause is known only as text.
[[noreturn]] void fail_to_write(const std::filesystem::path& file, std::string_view cause);

}  // namespace breccia
