// One run at a time in a folder of results, and a list of what breccia wrote there: both in
// DIR/.breccia-files. The run that writes holds a lock on the file, which the system lets go of
// when the run ends, however it does. The file stays, so that the next run knows which files are
// not the user's.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace breccia {

inline constexpr const char* folder_list = ".breccia-files";

/// Held until it goes.
class FolderLock {
public:
  FolderLock() = default;  ///< of no folder
  FolderLock(std::filesystem::path list, int opened) : list_(std::move(list)), opened_(opened) {}
  FolderLock(FolderLock&&) noexcept;
  FolderLock& operator=(FolderLock&&) noexcept;
  ~FolderLock();
  explicit operator bool() const { return opened_ >= 0; }

  /// What breccia wrote in this folder: names seen from it, a * standing for digits.
  std::vector<std::string> names() const;
  /// Replaces the list. @throws WriteError
  void write(const std::vector<std::string>& names) const;

private:
  std::filesystem::path list_;
  int opened_ = -1;
};

/// Locks a folder that is there. On a file system without locks it goes on without one.
/// @throws BadInput when another run holds the lock; WriteError when the list cannot be opened or
///         made
FolderLock lock_folder(const std::filesystem::path& folder);

/// The same where breccia has written before; elsewhere no lock, and nothing is made.
FolderLock lock_folder_if_used(const std::filesystem::path& folder);

}  // namespace breccia
