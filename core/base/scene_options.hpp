// Choices that a case makes and the core obeys.
#pragma once
#include <string_view>

namespace breccia {

/// How the area factor alpha of the bonds is found: docs/model.md, "The area factor".
enum class AlphaRule { automatic, affine, porosity, number };

/// paper: k_s/k_n = 1/(2(1 + nu)); matched: k_s/k_n and alpha such that the specimen has the E and
/// the nu asked for.
enum class Elasticity { paper, matched };

/// plane: two dimensions, discs of unit thickness in the x-z plane (y = 0); areas are lengths times
/// 1 m.
enum class Space { three_d, two_d };

/// Where the area of a bond comes from: docs/model.md, "Area".
enum class AreaRule { minimum, harmonic, cone, polyhedron, voronoi };

/// How forces of bonds whose ends are shared between threads are summed.
enum class ScatterKind { atomic, private_sums, gather };

/// Which particles the loading holds. ends: layers at both ends. strips: two strips along the
/// lateral surface of a disc on edge. halves: the two halves of the lateral surface and the end
/// layers with them, a direct shear box. vice: the lowest layer, and the two ends along x up to
/// half the height.
enum class Support { ends, strips, halves, vice };

/// How the dashpots of bonds and contacts enter the step: docs/model.md, "Time step and mass
/// scaling". explicit_: c_n as it is; capped and summed hold back those that are too strong for the
/// step.
enum class DampingScheme { explicit_, capped, summed };

inline std::string_view name_of(DampingScheme scheme) {
  return scheme == DampingScheme::capped ? "capped" : scheme == DampingScheme::summed ? "summed" : "explicit";
}

/// How bonds answer stage 1 of a test under confinement: elastically, so that loading begins on an
/// elastic branch, or by their law, which may yield. docs/model.md, "Confined tests".
enum class HydrostaticResponse { elastic, law };

/// What fluid pressure on a particle of the lateral surface acts on: pi r^2, or its share of the
/// whole (Voronoi).
enum class SkinWeights { radius, voronoi };

}  // namespace breccia
