// Choices that a case makes and the core obeys.
#pragma once

namespace breccia {

/// How the area factor alpha of the bonds is found (MODEL: alpha).
enum class AlphaRule { automatic, affine, porosity, number };

/// paper: k_s/k_n = 1/(2(1 + nu)); matched: k_s/k_n and alpha such that the specimen has the E and the nu
/// asked for.
enum class Elasticity { paper, matched };

/// How forces of bonds whose ends are shared between threads are summed.
enum class ScatterKind { atomic, private_sums, gather };

/// plane: discs of unit thickness in the x-z plane, y = 0.
enum class Space { solid, plane };

}  // namespace breccia
