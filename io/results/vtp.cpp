#include "io/results/vtp.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <iterator>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.hpp"
#include "core/tables/row_order.hpp"
#include "io/files/atomic_write.hpp"
#include "io/results/pvd.hpp"

namespace breccia {
namespace {

static_assert(std::endian::native == std::endian::little, "the files say LittleEndian");

/// One array of a .vtp: its declaration, and its bytes for the appended part.
struct Array {
  std::string name;
  std::string_view type;
  int components = 1;
  std::string bytes;
};

struct Picture {
  std::size_t points = 0, verts = 0, lines = 0;
  Array positions, connectivity, offsets;
  std::vector<Array> point_data, cell_data;
};

template <class T>
void put(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

// Single precision is enough for a picture and halves the files; ids stay whole.
void put_value(std::string& bytes, double value) { put(bytes, static_cast<float>(value)); }
void put_value(std::string& bytes, Gid value) { put(bytes, value); }
void put_value(std::string& bytes, const Vec3& value) {
  put_value(bytes, value.x);
  put_value(bytes, value.y);
  put_value(bytes, value.z);
}

template <class T>
constexpr std::string_view type_of = "Float32";
template <>
constexpr std::string_view type_of<Gid> = "UInt64";
template <>
constexpr std::string_view type_of<std::uint8_t> = "UInt8";
template <class T>
constexpr int components_of = 1;
template <>
constexpr int components_of<Vec3> = 3;

void put_value(std::string& bytes, std::uint8_t value) { put(bytes, value); }

/// The array of value(row) over the rows, in their order.
template <class Value>
Array array_of(std::string_view name, std::span<const Row> rows, Value&& value) {
  using T = std::decay_t<decltype(value(Row{}))>;
  Array array{std::string(name), type_of<T>, components_of<T>, {}};
  array.bytes.reserve(rows.size() * sizeof(T));
  for (const Row row : rows) put_value(array.bytes, value(row));
  return array;
}

/// A column of the table. Row columns are scratch and never come here.
template <class AnyColumn>
void add_column(std::vector<Array>& arrays, const ColumnInfo& info, const AnyColumn& column,
                std::span<const Row> rows) {
  if (info.role == Role::scratch || column.empty()) return;
  if constexpr (!std::is_same_v<ValueOf<AnyColumn>, Row>) {
    arrays.push_back(array_of(info.name, rows, [&](Row row) { return column[row]; }));
  }
}

/// 0, step, 2 step, ... or 1 step, 2 step, ...: connectivity and offsets of cells of one size.
Array counting(std::string_view name, std::size_t count, std::int32_t first, std::int32_t step) {
  Array array{std::string(name), "Int32", 1, {}};
  array.bytes.reserve(count * sizeof(std::int32_t));
  for (std::size_t i = 0; i < count; ++i) put(array.bytes, first + static_cast<std::int32_t>(i) * step);
  return array;
}

void check_count(const std::filesystem::path& file, std::size_t count) {
  if (count > std::numeric_limits<std::int32_t>::max() / 2) {
    fail<WriteError>(
        "cannot write {}: {} rows are more than a .vtp with 32-bit cells holds; set output.frames = 0",
        file.string(), count);
  }
}

std::string text_of(const Picture& picture) {
  std::string text, appended;
  const auto out = std::back_inserter(text);
  const auto declare = [&](const Array& array) {
    fmt::format_to(out,
                   "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" "
                   "offset=\"{}\"/>\n",
                   array.type, array.name, array.components, appended.size());
    put(appended, static_cast<std::uint64_t>(array.bytes.size()));
    appended += array.bytes;
  };
  text +=
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
      "<PolyData>\n";
  fmt::format_to(
      out,
      "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"0\">\n<PointData>\n",
      picture.points, picture.verts, picture.lines);
  for (const Array& array : picture.point_data) declare(array);
  text += "</PointData>\n<CellData>\n";
  for (const Array& array : picture.cell_data) declare(array);
  text += "</CellData>\n<Points>\n";
  declare(picture.positions);
  const std::string_view cells = picture.verts > 0 ? "Verts" : "Lines";
  fmt::format_to(out, "</Points>\n<{}>\n", cells);
  declare(picture.connectivity);
  declare(picture.offsets);
  fmt::format_to(out, "</{}>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_", cells);
  text += appended;
  text += "\n</AppendedData>\n</VTKFile>\n";
  return text;
}

}  // namespace

void write_particles_vtp(const std::filesystem::path& file, const ParticleTable& particles) {
  check_count(file, particles.size);
  const std::vector<Row> rows = rows_by_gid(particles);
  Picture picture;
  picture.points = picture.verts = rows.size();
  picture.positions = array_of("position", rows, [&](Row row) { return particles.position[row]; });
  picture.connectivity = counting("connectivity", rows.size(), 0, 1);
  picture.offsets = counting("offsets", rows.size(), 1, 1);
  // taken in double precision: displacements are far smaller than positions
  picture.point_data.push_back(array_of("displacement", rows, [&](Row row) {
    return particles.position[row] - particles.reference_position[row];
  }));
  picture.point_data.push_back(array_of(
      "held", rows, [&](Row row) { return static_cast<std::uint8_t>(row >= particles.free ? 1 : 0); }));
  particles.for_each_column([&](const ColumnInfo& info, const auto& column) {
    // both are in the picture already: as points, and as displacements
    if (info.name == "position" || info.name == "reference_position") return;
    add_column(picture.point_data, info, column, rows);
  });
  atomic_write(file, text_of(picture));
}

void write_bonds_vtp(const std::filesystem::path& file, const ParticleTable& particles,
                     const BondTable& bonds) {
  check_count(file, particles.size);
  check_count(file, bonds.size);
  const std::vector<Row> points = rows_by_gid(particles);
  std::vector<std::int32_t> point_of_row(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) point_of_row[points[i]] = static_cast<std::int32_t>(i);

  const std::vector<Row> rows = rows_by_ends(bonds);
  Picture picture;
  picture.points = points.size();
  picture.lines = rows.size();
  picture.positions = array_of("position", points, [&](Row row) { return particles.position[row]; });
  picture.connectivity = Array{"connectivity", "Int32", 1, {}};
  for (const Row row : rows) {
    put(picture.connectivity.bytes, point_of_row[bonds.row_lo[row]]);
    put(picture.connectivity.bytes, point_of_row[bonds.row_hi[row]]);
  }
  picture.offsets = counting("offsets", rows.size(), 2, 2);
  picture.cell_data.push_back(
      array_of("state", rows, [&](Row row) { return static_cast<std::uint8_t>(bond_state(bonds, row)); }));
  // one vector rather than its three components
  picture.cell_data.push_back(array_of("shear_force", rows, [&](Row row) {
    return Vec3{bonds.shear_x[row], bonds.shear_y[row], bonds.shear_z[row]};
  }));
  bonds.for_each_column([&](const ColumnInfo& info, const auto& column) {
    if (!info.name.starts_with("shear_")) add_column(picture.cell_data, info, column, rows);
  });
  atomic_write(file, text_of(picture));
}

void write_frame_vtp(const std::filesystem::path& frames, int run, int frame, double time_s,
                     const ParticleTable& particles, const BondTable& bonds) {
  const std::string folder = fmt::format("run-{}", run);
  make_folder(frames / folder);
  const PvdEntry entry{frame, time_s, fmt::format("{}/particles-{:03}.vtp", folder, frame),
                       fmt::format("{}/bonds-{:03}.vtp", folder, frame)};
  write_particles_vtp(frames / entry.particles, particles);
  write_bonds_vtp(frames / entry.bonds, particles, bonds);
  add_to_pvd(frames / (folder + ".pvd"), entry);  // last: it never names a file that is not there
}

}  // namespace breccia
