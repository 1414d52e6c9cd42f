// Room on a disk, claimed before a library that does not stand a full one writes there.
#pragma once
#include <cstddef>
#include <filesystem>

namespace breccia {

/// Makes a file so much longer, or leaves it as it was. Who writes it cuts off what it did not
/// need.
/// @throws WriteError when the disk has no room, or the file is not there
void preallocate(const std::filesystem::path& file, std::size_t bytes);

}  // namespace breccia
