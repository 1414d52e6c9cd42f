#include "core/studies/layouts/byte_count.hpp"

#include "kernels/single/single.hpp"

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

ByteCount single_bytes_per_bond(const BondTable& bonds, const ParticleTable& particles) {
  const double share = static_cast<double>(particles.size) / static_cast<double>(bonds.size);
  ByteCount n;
  n.read = static_cast<double>(sizeof(BondBlock) + 1) / bond_block;  // and whether one of them is damaged
  n.read += share * static_cast<double>(sizeof(MotionRecord) + sizeof(IntegerSums));
  n.written = 3.0 * sizeof(float) + share * static_cast<double>(sizeof(IntegerSums));
  n.set = n.read;
  return n;
}

}  // namespace breccia
