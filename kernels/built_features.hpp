// The feature sets that are built: each is one kernel per instruction set. A scene that asks for another one
// runs the first of these that covers it, so they stand from the leanest to the fullest.
#pragma once
#include <array>

#include "kernels/features.hpp"

namespace breccia {

inline constexpr std::array built_feature_sets{
    Features{.plasticity = false, .breakage = false},
    Features{.plasticity = false},
    Features{},
    Features{.criterion = Criterion::coupled},
    Features{.criterion = Criterion::mohr_coulomb},
    Features{.rotation = false},
    Features{.rotation = false, .criterion = Criterion::coupled},
    Features{.rotation = false, .criterion = Criterion::mohr_coulomb},
};

}  // namespace breccia
