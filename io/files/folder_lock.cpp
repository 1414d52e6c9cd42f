#include "io/files/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <utility>

#include "core/base/error.hpp"
#include "io/files/write_error.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view heading = "# what breccia wrote here: --force removes these files and no others\n";

/// A name of the list: inside the folder.
bool is_name(const std::string& line) {
  if (line.empty() || line.front() == '#') return false;
  const fs::path path(line);
  for (const fs::path& part : path)
    if (part == "..") return false;
  return path.is_relative();
}

}  // namespace

FolderLock::FolderLock(FolderLock&& other) noexcept
    : list_(std::move(other.list_)), opened_(std::exchange(other.opened_, -1)) {}

FolderLock& FolderLock::operator=(FolderLock&& other) noexcept {
  std::swap(list_, other.list_);
  std::swap(opened_, other.opened_);
  return *this;
}

FolderLock::~FolderLock() {
  if (opened_ >= 0) ::close(opened_);
}

std::vector<std::string> FolderLock::names() const {
  std::string text;
  std::array<char, 4096> piece{};
  for (ssize_t got; opened_ >= 0;) {
    got = ::pread(opened_, piece.data(), piece.size(), static_cast<off_t>(text.size()));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    text.append(piece.data(), static_cast<std::size_t>(got));
  }
  std::vector<std::string> names;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    if (end == std::string::npos) break;  // a line that was cut off
    if (std::string line = text.substr(at, end - at); is_name(line)) names.push_back(std::move(line));
    at = end + 1;
  }
  return names;
}

void FolderLock::write(const std::vector<std::string>& names) const {
  std::string text(heading);
  for (const std::string& name : names) text += name + '\n';
  // in place, since the lock is on this very file
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t written = ::pwrite(opened_, text.data() + at, text.size() - at, static_cast<off_t>(at));
    if (written < 0 && errno != EINTR) fail_to_write(list_, errno);
    if (written > 0) at += static_cast<std::size_t>(written);
  }
  if (::ftruncate(opened_, static_cast<off_t>(text.size())) != 0) fail_to_write(list_, errno);
  if (::fsync(opened_) != 0 && errno != EINVAL && errno != EROFS && errno != EINTR)
    fail_to_write(list_, errno);
}

FolderLock lock_folder(const fs::path& folder) {
  const fs::path list = folder / folder_list;
  const int opened = ::open(list.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
  if (opened < 0) fail_to_write(list, errno);
  FolderLock lock(list, opened);
  struct stat found {};
  if (::fstat(opened, &found) != 0 || !S_ISREG(found.st_mode)) fail_to_write(list, "it is no file");
  if (::flock(opened, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    fail<BadInput>(
        "{}: another run is writing there; wait until it has ended, or choose another folder with --out",
        folder.string());
  return lock;
}

FolderLock lock_folder_if_used(const fs::path& folder) {
  std::error_code ignored;
  return fs::exists(fs::symlink_status(folder / folder_list, ignored)) ? lock_folder(folder) : FolderLock();
}

}  // namespace breccia
