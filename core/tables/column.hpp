// A column of a table is declared once, in one line of a COLUMNS macro: type, name, unit, role,
// feature that needs it, meaning. Storage, results, ParaView output and the printed documentation
// derive from that line.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "kernels/math/vec3.hpp"

namespace breccia {

using Gid = std::uint64_t;  ///< global id of a particle, as in the specimen's file
using Row = std::uint32_t;  ///< row of a table on this rank

/// What a column is for. Identity, reference, history and state are saved and sent; derived is
/// worked out for output; scratch is neither. A ledger column is saved and sent too, but no part of
/// the state: nothing moves otherwise for it.
enum class Role { identity, reference, history, state, ledger, derived, scratch };

/// The feature of the scene without which a column has no storage.
enum class Need {
  always,
  rotation,
  contact_damping,
  plasticity,
  breakage,
  strength_area,
  ledger,
  stress,
  orientation,
  rolling,
  several,
  hertz,
  single
};

struct ColumnInfo {
  std::string_view type, name, unit;
  Role role;
  Need need;
  std::string_view meaning;
};

std::string_view name_of(Role);
std::string_view name_of(Need);

}  // namespace breccia
