// What a file holds, as one line of hex: the same digest as that of the command sha256sum.
#pragma once
#include <filesystem>
#include <string>

namespace breccia {

/// SHA-256 of the bytes of a file, 64 hex digits.
/// @throws BadInput when it cannot be read
std::string sha256_of(const std::filesystem::path& file);

}  // namespace breccia
