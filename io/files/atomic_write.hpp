// Files that are whole or absent: written beside their place, flushed to the disk, then renamed.
#pragma once
#include <filesystem>
#include <string_view>

namespace breccia {

/// Replaces `file` by one with this content. A reader, or a kill at any moment, meets the old file or the new
/// one.
/// @throws FileTrouble; the old file is then as it was
void write_aside(const std::filesystem::path& file, std::string_view content);

/// Where `write_aside` and others write before they rename: FILE.part, in the same folder.
std::filesystem::path name_aside(const std::filesystem::path& file);

/// Flushes a file that was written aside and gives it its name.
/// @throws FileTrouble; the file aside is then removed
void move_into_place(const std::filesystem::path& aside, const std::filesystem::path& file);

/// Waits until the content of a file is on the disk: some file systems notice only then that they are full.
/// @throws FileTrouble
void flush_to_disk(const std::filesystem::path& file);

/// Makes a folder and those above it. One that exists is left as it is.
/// @throws FileTrouble
void make_folder(const std::filesystem::path& folder);

}  // namespace breccia
