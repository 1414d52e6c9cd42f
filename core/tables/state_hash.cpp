#include "core/tables/state_hash.hpp"

#include <fmt/format.h>

#include <cstring>

#include "core/tables/row_order.hpp"

namespace breccia {
namespace {

/// FNV-1a over the bytes of rows in a given order.
template <class Table>
void add(std::uint64_t& hash, const Table& table, const std::vector<Row>& order) {
  table.for_each_column([&](const ColumnInfo& info, const auto& column) {
    const bool hashed = info.role == Role::identity || info.role == Role::history || info.role == Role::state;
    if (!hashed || column.empty()) return;
    using Value = std::decay_t<decltype(column[0])>;
    constexpr std::size_t size =
        std::is_same_v<Value, Vec3> ? 3 * sizeof(double) : sizeof(Value);  // no padding
    for (const Row row : order) {
      unsigned char bytes[size];
      std::memcpy(bytes, &column[row], size);
      for (const unsigned char byte : bytes) hash = (hash ^ byte) * 0x100000001b3ull;
    }
  });
}

}  // namespace

std::string state_hash(const ParticleTable& particles, const BondTable& bonds) {
  std::uint64_t hash = 0xcbf29ce484222325ull;
  add(hash, particles, rows_by_gid(particles));
  add(hash, bonds, rows_by_ends(bonds));
  return fmt::format("{:016x}", hash);
}

}  // namespace breccia
