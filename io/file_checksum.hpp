// A seal behind a file: a checksum of all that is before it. Formats that know where they end (HDF5) do not mind.
#pragma once
#include <cstddef>
#include <filesystem>

namespace breccia {

/// Adds the seal. @throws FileTrouble
void seal(const std::filesystem::path& file);

/// False when a byte has changed since, or the file is shorter or longer than it was.
bool is_sealed(const std::filesystem::path& file);

/// Makes an empty file behind which so many bytes are claimed on the disk: a full disk is met here, not half-way.
/// They are given back when the file is truncated. @throws FileTrouble
void claim_room(const std::filesystem::path& file, std::size_t bytes);

}  // namespace breccia
