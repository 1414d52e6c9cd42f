// What of a specimen hangs together: the pieces into which bonds join its spheres, and what hangs
// on nothing between the bodies that the loading holds.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/bonding/assembly.hpp"
#include "core/geometry/cell_list.hpp"

namespace breccia {

/// Spheres that links join, directly or through others.
struct Pieces {
  std::vector<std::uint32_t> of;   ///< per sphere, the number of its piece; the largest is 0
  std::vector<std::size_t> sizes;  ///< per piece, falling; a sphere without a link is a piece of its own
};
Pieces pieces_of(std::size_t spheres, std::span<const RowPair> links);

/// How a bonded specimen hangs together.
struct Connection {
  std::vector<std::size_t> pieces;  ///< spheres of each piece of two or more that bonds join, falling
  std::size_t unbonded = 0;         ///< spheres without a bond
  std::size_t loose = 0;  ///< spheres that hang on nothing: unbonded, or in a piece that carries no load
  bool by_bonds = false;  ///< a piece reaches from one held body to the other
  bool joined = false;    ///< the same, where surfaces that touch may help
};

/// Looks at the bonds of an assembly, and leaves out what hangs on nothing: it belongs to no gauge
/// and to no pressed surface (Assembly::loose, Assembly::lateral).
/// @param contacts  whether the run has contacts: pieces that touch then carry load through each
///         other
Connection leave_out_loose(Assembly& assembly, bool contacts, int threads);

/// Spheres with neighbours to speak of: what is far from all others must not move the middle of a
/// specimen.
struct MainBody {
  std::vector<char> has;   ///< per sphere, 1 in a piece of a tenth of the largest or more
  std::size_t pieces = 1;  ///< of that size, that are apart from each other
};
/// @param range  spheres nearer than (1 + range)(r_i + r_j) hang together
MainBody main_body(const Specimen& specimen, double range, int threads);

}  // namespace breccia
