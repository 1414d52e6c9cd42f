#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iterator>

#include "core/base/error.hpp"
#include "io/specimens/read_specimen.hpp"

namespace breccia {

void write_specimen_csv(const std::filesystem::path& file, const Specimen& specimen) {
  const auto& spheres = specimen.spheres;
  const bool groups = std::any_of(spheres.begin(), spheres.end(), [](const auto& s) { return s.group != 1; });
  fmt::memory_buffer text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "id,x_m,y_m,z_m,r_m{}\n", groups ? ",group" : "");
  for (const SpecimenSphere& s : spheres) {
    fmt::format_to(out, "{},{},{},{},{}", s.id, s.centre.x, s.centre.y, s.centre.z,
                   s.radius);  // shortest that reads back
    if (groups) fmt::format_to(out, ",{}", s.group);
    text.push_back('\n');
  }
  const std::filesystem::path aside = file.string() + ".part";
  std::FILE* stream = std::fopen(aside.c_str(), "wb");
  if (!stream) fail<WriteError>("{}: cannot be written: {}", file.string(), std::strerror(errno));
  const bool written = std::fwrite(text.data(), 1, text.size(), stream) == text.size();
  const bool closed = std::fclose(stream) == 0;  // a full disk may show only here
  std::error_code trouble;
  if (written && closed) std::filesystem::rename(aside, file, trouble);
  if (written && closed && !trouble) return;
  const std::string cause = trouble ? trouble.message() : std::strerror(errno);
  std::error_code ignored;
  std::filesystem::remove(aside, ignored);
  fail<WriteError>("{}: cannot be written: {}", file.string(), cause);
}

}  // namespace breccia
