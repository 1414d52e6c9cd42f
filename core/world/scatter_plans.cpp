#include "core/world/scatter_plans.hpp"

namespace breccia {

void plan_bonds(World& w) {
  const BondTable& b = w.bonds;
  // the padding behind the bonds of one rank has no ids; of several, ghosts and padding lie between
  const std::size_t ids = w.partition.ranks.alone() ? b.size : b.padded;
  // integers add up to the same in any order
  const bool single = w.options.precision == Precision::single;
  const ScatterKind kind =
      single && w.options.scatter == ScatterKind::gather ? ScatterKind::private_sums : w.options.scatter;
  w.bond_plan = plan_scatter(kind, w.options.threads, ForceBuffer::capacity, b.row_lo, b.row_hi,
                             std::span(b.gid_lo).first(ids), std::span(b.gid_hi).first(ids), b.arm_offset,
                             w.particles.size);
}

void plan_contacts(World& w) {
  const ContactTable& c = w.contacts;
  // the few contacts are added in a fixed order where the bonds' sums have none
  const bool single = w.options.precision == Precision::single;
  w.contact_plan =
      plan_scatter(single ? ScatterKind::gather : w.options.scatter, w.options.threads, ForceBuffer::capacity,
                   c.row_lo, c.row_hi, c.gid_lo, c.gid_hi, c.arm_offset, w.particles.size);
}

}  // namespace breccia
