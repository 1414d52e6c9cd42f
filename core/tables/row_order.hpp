// Rows of this rank in the order of global ids, whatever the order in memory is. Over several
// ranks: core/ranks/file_order.hpp
#pragma once
#include <vector>

#include "core/tables/bond_table.hpp"
#include "core/tables/contact_table.hpp"
#include "core/tables/particle_table.hpp"

namespace breccia {

/// Rows [0, size) of the particles in order of their global ids.
std::vector<Row> rows_by_gid(const ParticleTable& particles);
/// Rows [first, last) of them.
std::vector<Row> rows_by_gid(const ParticleTable& particles, std::size_t first, std::size_t last);

/// Rows [0, size) of the bonds in order of (gid_lo, gid_hi); the padding is left out.
std::vector<Row> rows_by_ends(const BondTable& bonds);
std::vector<Row> rows_by_ends(const ContactTable& contacts);

}  // namespace breccia
