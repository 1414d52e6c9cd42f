// Files that are whole or absent: written beside their place, flushed to the disk, then renamed.
#pragma once
#include <filesystem>
#include <string_view>

namespace breccia {

/// Replaces `file` by one with this content. A reader, or a kill at any moment, meets the old file
/// or the new one.
/// @throws WriteError; the old file is then as it was
void atomic_write(const std::filesystem::path& file, std::string_view content);

/// Where `atomic_write` and others write before they rename: FILE.part, in the same folder.
std::filesystem::path name_aside(const std::filesystem::path& file);

/// Flushes a file that was written aside and gives it its name.
/// @throws WriteError; the file aside is then removed
void move_into_place(const std::filesystem::path& aside, const std::filesystem::path& file);

/// Waits until the content of a file is on the disk: some file systems notice only then that they
/// are full.
/// @throws WriteError
void flush_to_disk(const std::filesystem::path& file);

/// Makes a folder and those above it. One that exists is left as it is.
/// @throws WriteError
void make_folder(const std::filesystem::path& folder);

}  // namespace breccia
