#include "io/results/pvd.hpp"

#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <string_view>

#include "io/files/atomic_write.hpp"

namespace breccia {
namespace {

constexpr std::string_view frame_mark = "  <!-- frame ";

/// The frame that a line of ours begins, or -1.
int frame_of(std::string_view line) {
  int frame = -1;
  if (line.starts_with(frame_mark)) {
    line.remove_prefix(frame_mark.size());
    std::from_chars(line.data(), line.data() + line.size(), frame);
  }
  return frame;
}

/// The lines of an existing file that belong to frames below `end`; nothing where there is no such
/// file.
std::string frames_below(const std::filesystem::path& file, int end) {
  std::ifstream in(file);
  std::string kept, line;
  bool keep = false;
  while (std::getline(in, line)) {
    if (const int frame = frame_of(line); frame >= 0) keep = frame < end;
    if (line.find("</Collection>") != std::string::npos) break;
    if (keep) kept += line + '\n';
  }
  return kept;
}

}  // namespace

void add_to_pvd(const std::filesystem::path& file, const PvdEntry& entry) {
  const std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n"
      "{}{}{} -->\n"
      "  <DataSet timestep=\"{}\" part=\"0\" name=\"particles\" file=\"{}\"/>\n"
      "  <DataSet timestep=\"{}\" part=\"1\" name=\"bonds\" file=\"{}\"/>\n"
      "</Collection>\n</VTKFile>\n",
      frames_below(file, entry.frame), frame_mark, entry.frame, entry.time_s, entry.particles, entry.time_s,
      entry.bonds);
  atomic_write(file, text);
}

}  // namespace breccia
