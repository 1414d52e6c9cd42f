#include "io/text/input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "core/base/error.hpp"

namespace breccia {
namespace {

std::string said(int error) {
  if (error == ENOENT || error == ENOTDIR) return "no such file";
  if (error == EACCES) return "cannot be read; are its rights as they should be?";
  return "cannot be read: " + std::generic_category().message(error);
}

std::string reason(const struct stat& found) {
  if (S_ISREG(found.st_mode)) return {};
  if (S_ISDIR(found.st_mode)) return "a folder, not a file";
  if (S_ISFIFO(found.st_mode)) return "a pipe, not a file; write what comes out of it to a file first";
  return S_ISSOCK(found.st_mode) ? "a socket, not a file" : "a device, not a file";
}

}  // namespace

std::string why_no_file(const std::filesystem::path& path) {
  struct stat found {};
  return ::stat(path.c_str(), &found) != 0 ? said(errno) : reason(found);
}

InputFile open_input(const std::filesystem::path& file) {
  // looked at before it is opened, since that alone may wind a device, and after, since names
  // change hands
  std::string why = why_no_file(file);
  const int opened = why.empty() ? ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC) : -1;
  if (why.empty()) {
    struct stat found {};
    why = opened < 0 || ::fstat(opened, &found) != 0 ? said(errno) : reason(found);
  }
  InputFile stream(why.empty() ? ::fdopen(opened, "rb") : nullptr, &std::fclose);
  if (!stream) {
    if (opened >= 0) ::close(opened);
    fail<BadInput>("{}: {}", file.string(), why.empty() ? "cannot be read" : why);
  }
  return stream;
}

std::string read_bytes(const std::filesystem::path& file) {
  const InputFile stream = open_input(file);
  std::string text;
  std::size_t got = 0, step = std::size_t{1} << 20;
  do {
    text.resize(text.size() + step);
    got = std::fread(text.data() + text.size() - step, 1, step, stream.get());
    text.resize(text.size() - step + got);
    step = std::max(step, text.size());
  } while (got > 0);
  if (std::ferror(stream.get())) fail<BadInput>("{}: cannot be read to its end", file.string());
  return text;
}

std::vector<std::string> names_in(const std::filesystem::path& folder,
                                  const std::filesystem::path& extension) {
  std::vector<std::string> names;
  std::error_code trouble;  // the iterator's own ++ would throw
  for (std::filesystem::directory_iterator at(folder, trouble), end; !trouble && at != end;
       at.increment(trouble))
    if (at->path().extension() == extension) names.push_back(at->path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace breccia
