#include "io/specimens/read_csv.hpp"

#include <algorithm>
#include <array>

#include "core/base/error.hpp"
#include "io/text/suggest.hpp"
#include "io/text/text_file.hpp"

namespace breccia {
namespace {

constexpr std::string_view header = "id,x_m,y_m,z_m,r_m";
constexpr std::size_t columns = 5, most_columns = 6;
using Fields = std::array<std::string_view, most_columns + 1>;

/// Splits at commas; counts one field too many, but no further.
std::size_t split(std::string_view line, Fields& fields) {
  std::size_t count = 0;
  while (count < fields.size()) {
    const std::size_t comma = line.find(',');
    fields[count++] = trim(line.substr(0, comma));
    if (comma == std::string_view::npos) break;
    line.remove_prefix(comma + 1);
  }
  return count;
}

bool next_row(LineReader& reader, std::string_view& line) {
  while (reader.next(line))
    if (!line.empty() && line.front() != '#') return true;
  return false;
}

/// Number of columns that the header announces.
std::size_t check_header(std::string_view line, const LineReader& reader) {
  std::string names;
  for (char c : line)
    if (c != ' ' && c != '\t') names += c;
  if (names == header) return columns;
  if (names == std::string(header) + ",group") return most_columns;
  fail<BadInput>("{}: the header is {}; it must be \"{}\", or that and \",group\"", reader.place(),
                 quote(line), header);
}

}  // namespace

std::vector<SpecimenSphere> spheres_from_csv(const std::string& name, std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);  // the mark that spreadsheets put in front
  LineReader reader(name, text);
  std::string_view line;
  if (!next_row(reader, line)) fail<BadInput>("{}: the file is empty", name);
  const std::size_t wanted = check_header(line, reader);

  std::vector<SpecimenSphere> spheres;
  spheres.reserve(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')));
  Fields fields;
  while (next_row(reader, line)) {
    const std::size_t count = split(line, fields);
    if (count != wanted)
      fail<BadInput>("{}: {}{} columns, the header has {}", reader.place(),
                     count > most_columns ? "more than " : "", std::min(count, most_columns), wanted);
    SpecimenSphere& sphere = spheres.emplace_back();
    sphere.id = to_id(fields[0], "id", reader);
    sphere.centre = {to_number(fields[1], "x_m", reader), to_number(fields[2], "y_m", reader),
                     to_number(fields[3], "z_m", reader)};
    sphere.radius = to_number(fields[4], "r_m", reader);
    if (wanted == most_columns) sphere.group = to_group(fields[5], reader);
    sphere.line = reader.line_number();
  }
  return spheres;
}

}  // namespace breccia
