// Bonds between spheres of several materials: docs/model.md, "Several materials".
#pragma once
#include <span>
#include <vector>

#include "kernels/laws/bond_laws.hpp"

namespace breccia {

/// A material and the k_s/k_n that its Poisson ratio asks for.
struct BondMaterial {
  Material material;
  double shear_ratio = 0;
};

/// Of bonds between two materials (B125): E, nu and stiffnesses as two springs in a row, harmonic
/// means; strengths and all other numbers arithmetic means.
BondMaterial between(const BondMaterial& one, const BondMaterial& other);

/// Row in a scene's laws of bonds between spheres of two materials.
LawIndex law_between(LawIndex one, LawIndex other, std::size_t materials);

/// Calls visit(one, other) for each pair of materials, in the order of law_between.
template <class Visit>
void for_each_pair(std::size_t materials, const Visit& visit) {
  for (std::size_t one = 0; one < materials; ++one)
    for (std::size_t other = one; other < materials; ++other) visit(one, other);
}

/// Most materials of one scene: their pairs are numbered in a byte.
inline constexpr std::size_t most_materials = 20;

/// The key that only one of two materials has, of those that exclude others; empty: none. A mean of
/// a fracture energy and a damage would be neither.
std::string_view unmatched(const Material& one, const Material& other);

}  // namespace breccia
