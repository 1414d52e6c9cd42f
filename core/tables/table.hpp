// What a COLUMNS macro makes: one vector per column, and a visitor over all of them.
#pragma once
#include <functional>
#include <type_traits>
#include <vector>

#include "core/tables/column.hpp"
#include "core/tables/column_storage.hpp"
#include "kernels/laws/features.hpp"

namespace breccia {

/// True when a scene with these features stores a column with this need.
constexpr bool is_needed(Need need, const Features& features) {
  switch (need) {
    case Need::always:
      return true;
    case Need::rotation:
      return features.rotation;
    case Need::contact_damping:
      return features.contact_damping;
    case Need::plasticity:
      return features.plasticity;
    case Need::breakage:
      return features.breakage;
    case Need::several:
      return features.several;
    case Need::strength_area:
    case Need::ledger:
    case Need::stress:
    case Need::orientation:
    case Need::rolling:
    case Need::hertz:
    case Need::single:
      return false;  // made by the one who fills it
  }
  return true;
}

/// The type of a column's values, whether it lies alone or in records.
template <class AnyColumn>
using ValueOf = typename std::decay_t<AnyColumn>::value_type;

/// Bytes that the columns of a table hold, padding included.
template <class Table>
std::size_t column_bytes(const Table& table) {
  std::size_t bytes = 0;
  table.for_each_column([&](const ColumnInfo&, const auto& column) {
    bytes += column.size() * sizeof(ValueOf<decltype(column)>);
  });
  return bytes;
}

}  // namespace breccia

#define BRECCIA_COLUMN_MEMBER(Type, column, unit, role, need, meaning) Column<Type> column;
#define BRECCIA_COLUMN_VISIT(Type, column, unit, role, need, meaning) \
  visit(ColumnInfo{#Type, #column, unit, Role::role, Need::need, meaning}, column);

/// The body of a table: its columns, `for_each_column(visit)` with visit(ColumnInfo, vector&), and
/// `resize(rows, features)`, which leaves the columns of absent features empty.
#define BRECCIA_TABLE(COLUMNS)                                                                 \
  COLUMNS(BRECCIA_COLUMN_MEMBER)                                                               \
  template <class Visit>                                                                       \
  void for_each_column(Visit&& visit) {                                                        \
    COLUMNS(BRECCIA_COLUMN_VISIT)                                                              \
  }                                                                                            \
  template <class Visit>                                                                       \
  void for_each_column(Visit&& visit) const {COLUMNS(BRECCIA_COLUMN_VISIT)} std::size_t size = \
      0;                  /* rows that mean something */                                       \
  std::size_t padded = 0; /* rows stored: size rounded up to whole batches */                  \
  void resize(std::size_t rows, const Features& features, std::size_t batch = 1) {             \
    size = rows;                                                                               \
    padded = (rows + batch - 1) / batch * batch;                                               \
    for_each_column([&](const ColumnInfo& info, auto& column) {                                \
      column.assign(is_needed(info.need, features) ? padded : 0, {});                          \
    });                                                                                        \
  }
