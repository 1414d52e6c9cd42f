// Some rows of a table of pairs, in an order of their own.
#pragma once
#include <span>

#include "core/tables/table.hpp"

namespace breccia {

/// Stands for a row of padding.
inline constexpr std::size_t no_row = ~std::size_t{0};

/// @param rows  of the whole table, or no_row
/// @param size  of the part, the rest of `rows` is padding or ghosts
template <class Table>
Table part_of_table(const Table& whole, std::span<const std::size_t> rows, std::size_t size) {
  Table t;
  t.size = size;
  t.padded = rows.size();
  t.for_each_column([&]<class T>(const ColumnInfo& info, Column<T>& column) {
    whole.for_each_column([&]<class U>(const ColumnInfo& other, const Column<U>& from) {
      if constexpr (std::is_same_v<T, U>) {
        if (other.name != info.name || from.empty()) return;
        column.reserve(t.padded);
        for (const std::size_t k : rows) column.push_back(k == no_row ? T{} : from[k]);
      }
    });
  });
  return t;
}

}  // namespace breccia
