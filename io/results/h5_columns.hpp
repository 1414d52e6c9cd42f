// Tables in HDF5: a dataset for each column, rows in an order that does not depend on where they
// lie in memory. Included by the .cpp files that write or read HDF5, by no header.
#pragma once
#include <span>
#include <vector>

#include "core/ranks/file_order.hpp"
#include "core/tables/column.hpp"
#include "io/results/h5.hpp"

namespace breccia {

template <class T>
constexpr h5::Number number_of = h5::Number::real;
template <>
inline constexpr h5::Number number_of<Gid> = h5::Number::id;
template <>
inline constexpr h5::Number number_of<std::uint8_t> = h5::Number::byte;
template <class T>
constexpr std::size_t components_of = 1;
template <>
inline constexpr std::size_t components_of<Vec3> = 3;

/// @param rows  those that this rank writes
template <class T>
void write_rows(hid_t group, const ColumnInfo& info, std::string_view role, const FileOrder& order,
                const std::vector<T>& rows, bool plain) {
  const auto write = [&](const void* numbers) {
    h5::write_dataset(group, {.name = std::string(info.name),
                              .unit = info.unit,
                              .role = role,
                              .meaning = info.meaning,
                              .number = number_of<T>,
                              .rows = order.total,
                              .components = components_of<T>,
                              .data = numbers,
                              .ranks = order.ranks,
                              .first = order.first,
                              .count = rows.size(),
                              .plain = plain});
  };
  if constexpr (std::is_same_v<T, Vec3>) {
    std::vector<double> packed;  // three numbers a row, without what fills a Vec3 up
    packed.reserve(3 * rows.size());
    for (const Vec3& v : rows) packed.insert(packed.end(), {v.x, v.y, v.z});
    write(packed.data());
  } else {
    write(rows.data());
  }
}

/// One dataset for each column of a wanted role that the scene has, its rows in the given order.
/// @param plain  as they are: see h5::Dataset
template <class Table>
void write_columns(hid_t group, const Table& table, const FileOrder& order, bool (*wanted)(Role),
                   bool plain) {
  table.for_each_column([&](const ColumnInfo& info, const auto& column) {
    using T = ValueOf<decltype(column)>;
    if constexpr (!std::is_same_v<T, Row>) {  // rows of this rank mean nothing outside; all are scratch
      if (!wanted(info.role)) return;
      // a rank without rows has no columns, but must take part where others have them
      if (!any(order.ranks, !column.empty())) return;
      const std::vector<T> rows = in_file_order<T>(order, [&](Row row) -> T { return column[row]; });
      write_rows(group, info, name_of(info.role), order, rows, plain);
    }
  });
}

/// Rows of a column as they lie in the file.
/// @throws h5::Failure when there are not `count` of them
template <class T>
std::vector<T> read_rows(hid_t group, const std::string& name, std::size_t count) {
  const std::size_t components = components_of<T>;
  if (h5::rows_of_dataset(group, name, components) != count)
    throw h5::Failure(name + " has another number of rows");
  std::vector<T> rows(count);
  if constexpr (std::is_same_v<T, Vec3>) {
    std::vector<double> packed(3 * count);
    if (count > 0) h5::read_dataset(group, name, h5::Number::real, packed.data());
    for (std::size_t k = 0; k < count; ++k) rows[k] = {packed[3 * k], packed[3 * k + 1], packed[3 * k + 2]};
  } else if (count > 0) {
    h5::read_dataset(group, name, number_of<T>, rows.data());
  }
  return rows;
}

/// The columns of a wanted role that the scene has, back into the rows that they came from.
template <class Table>
void read_columns(hid_t group, Table& table, std::span<const Row> order, bool (*wanted)(Role)) {
  table.for_each_column([&](const ColumnInfo& info, auto& column) {
    using T = ValueOf<decltype(column)>;
    if constexpr (!std::is_same_v<T, Row>) {
      if (!wanted(info.role) || column.empty()) return;
      const std::vector<T> rows = read_rows<T>(group, std::string(info.name), order.size());
      for (std::size_t k = 0; k < order.size(); ++k) column[order[k]] = rows[k];
    }
  });
}

}  // namespace breccia
