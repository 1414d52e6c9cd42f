#include "core/studies/layouts/byte_count.hpp"

namespace breccia {

ByteCount bytes_per_bond(const BondTable& bonds, const ParticleTable& particles) {
  ByteCount n;
  bonds.for_each_column([&](const ColumnInfo& info, const auto& column) {
    using T = ValueOf<decltype(column)>;
    if (column.empty() || info.role == Role::identity || info.role == Role::derived) return;
    n.read += sizeof(T);
    if (info.name.starts_with("shear_")) n.written += sizeof(T);
  });
  n.set = n.read;
  const double share = static_cast<double>(particles.size) / static_cast<double>(bonds.size);
  particles.for_each_column([&](const ColumnInfo& info, const auto& column) {
    using T = ValueOf<decltype(column)>;
    if (column.empty() || (info.role != Role::state && info.role != Role::scratch)) return;
    n.set += share * sizeof(T);
    n.read += share * sizeof(T);
    if (info.role == Role::scratch) n.written += share * sizeof(T);  // sums
  });
  return n;
}

}  // namespace breccia
