// What a program reads must be a file: a pipe may have nobody at its other end, a device may never
// end.
#pragma once
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace breccia {

/// Why there is no file to read at a path: "no such file", "a folder, not a file", ...; empty where
/// there is one. Links are followed.
std::string why_no_file(const std::filesystem::path& path);

using InputFile = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// Opens a file to be read, without ever waiting.
/// @throws BadInput: the file, and why it cannot be read
InputFile open_input(const std::filesystem::path& file);

/// All bytes of a file. @throws BadInput
std::string read_bytes(const std::filesystem::path& file);

/// Names of what lies in a folder and ends so (".toml"), sorted; none where the folder cannot be
/// read.
std::vector<std::string> names_in(const std::filesystem::path& folder,
                                  const std::filesystem::path& extension);

}  // namespace breccia
