// What a case says, as the solver takes it.
#pragma once
#include <span>
#include <vector>

#include "core/bonding/several_materials.hpp"
#include "core/elastic/area_factor.hpp"
#include "core/loading/laboratory_tests.hpp"
#include "core/world/options.hpp"
#include "io/cases/case.hpp"

namespace breccia {

/// Of run number `run`, one for each confinement.
LoadTest load_test(const Case& c, const LaboratoryTest& test, std::size_t run, const AreaFactor& factor);

/// The material of that run, its limits those of bonds in this specimen and this test.
Material material_of_run(const Case& c, const LaboratoryTest& test, std::size_t run,
                         const AreaFactor& factor);

/// Those of its groups, with the k_s/k_n that the specimen needs for each.
/// @param group_factors  as if the whole specimen were of one group's material
std::vector<BondMaterial> materials_of_groups(const Case& c, const LaboratoryTest& test, std::size_t run,
                                              const AreaFactor& factor,
                                              std::span<const AreaFactor> group_factors);

/// @param asked  features of the scene
WorldOptions world_options(const Case& c, const LaboratoryTest& test, const Features& asked, int threads);

}  // namespace breccia
