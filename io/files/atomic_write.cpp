#include "io/files/atomic_write.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "io/files/write_error.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

/// 0, or errno of the call that failed.
int write_all(int file, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(file, content.data(), content.size());
    if (written < 0 && errno != EINTR) return errno;  // EINTR: a signal asked for a checkpoint
    if (written > 0) content.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

int flush(int file) {
  int result = ::fsync(file);
  while (result != 0 && errno == EINTR) result = ::fsync(file);
  // EINVAL, EROFS: a file system that has nothing to flush
  return result == 0 || errno == EINVAL || errno == EROFS ? 0 : errno;
}

int write_file(const fs::path& path, std::string_view content) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) return errno;
  int error = write_all(file, content);
  if (::close(file) != 0 && error == 0) error = errno;
  return error;
}

int flush_path(const fs::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return errno;
  const int error = flush(file);
  ::close(file);
  return error;
}

void remove_quietly(const fs::path& path) {
  std::error_code ignored;
  fs::remove(path, ignored);
}

}  // namespace

fs::path name_aside(const fs::path& file) {
  fs::path aside = file;
  aside += ".part";
  return aside;
}

void move_into_place(const fs::path& aside, const fs::path& file) {
  int error = flush_path(aside);
  if (error == 0 && ::rename(aside.c_str(), file.c_str()) != 0) error = errno;
  if (error != 0) {
    remove_quietly(aside);
    fail_to_write(file, error);
  }
  // The name itself is on the disk once the folder is; a failure here harms neither file.
  flush_path(file.has_parent_path() ? file.parent_path() : fs::path("."));
}

void atomic_write(const fs::path& file, std::string_view content) {
  const fs::path aside = name_aside(file);
  if (const int error = write_file(aside, content); error != 0) {
    remove_quietly(aside);
    fail_to_write(file, error);
  }
  move_into_place(aside, file);
}

void flush_to_disk(const fs::path& file) {
  if (const int error = flush_path(file); error != 0) fail_to_write(file, error);
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  // an existing file of that name is no error to create_directories
  if (!error && !fs::is_directory(folder, error) && !error)
    error = std::make_error_code(std::errc::not_a_directory);
  if (error) fail_to_write(folder, error.value());
}

}  // namespace breccia
