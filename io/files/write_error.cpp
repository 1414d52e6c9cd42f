#include "io/files/write_error.hpp"

#include <cerrno>
#include <system_error>

#include "core/base/error.hpp"

namespace breccia {
namespace {

std::string_view cure_of(int error) {
  switch (error) {
    case EFBIG:
      return "the limit on the size of a file is reached (ulimit -f): raise it, or write less ([output])";
    case ENOSPC:
    case EDQUOT:
      return "free some space, or choose another folder with --out";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a folder that you may write to with --out";
    case ENOTDIR:
    case EEXIST:
      return "a part of this path is a file: choose another folder with --out";
    case EISDIR:
      return "there is a folder of this name: remove it, or choose another folder with --out";
    default:
      return "choose another folder with --out";
  }
}

}  // namespace

void fail_to_write(const std::filesystem::path& file, int error) {
  fail<WriteError>("cannot write {}: {}; {}", file.string(), std::generic_category().message(error),
                   cure_of(error));
}

void fail_to_write(const std::filesystem::path& file, std::string_view cause) {
  fail<WriteError>("cannot write {}: {}; check the disk, or choose another folder with --out", file.string(),
                   cause);
}

}  // namespace breccia
