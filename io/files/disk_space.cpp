#include "io/files/disk_space.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

#include "io/files/write_error.hpp"

namespace breccia {

void preallocate(const std::filesystem::path& path, std::size_t bytes) {
  const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) fail_to_write(path, errno);
  const off_t size = ::lseek(file, 0, SEEK_END);
  int error = size < 0 ? errno : EINTR;  // EINTR: a signal asked for a checkpoint
  while (error == EINTR) error = ::posix_fallocate(file, size, static_cast<off_t>(bytes));
  if (error == EINVAL || error == EOPNOTSUPP) error = 0;  // the file system cannot: as good as it gets
  if (error != 0 && size >= 0 && ::ftruncate(file, size) != 0) error = errno;
  ::close(file);
  if (error != 0) fail_to_write(path, error);
}

}  // namespace breccia
