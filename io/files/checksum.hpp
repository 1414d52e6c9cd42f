// A seal behind a file: a checksum of all that is before it. Formats that know where they end
// (HDF5) do not mind.
#pragma once
#include <cstddef>
#include <filesystem>

namespace breccia {

/// Adds the seal. @throws WriteError
void append_checksum(const std::filesystem::path& file);

/// False when a byte has changed since, or the file is shorter or longer than it was.
bool is_sealed(const std::filesystem::path& file);

}  // namespace breccia
