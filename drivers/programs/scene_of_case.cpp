#include "drivers/programs/scene_of_case.hpp"

#include <algorithm>
#include <numbers>

#include "core/bonding/compressive_limits.hpp"

namespace breccia {
namespace {

/// Pa, 0 where none is asked for.
double intermediate_of(const Case& c, std::size_t run) {
  const auto& stress = c.test.intermediate_stress;
  return stress.empty() ? 0.0 : stress[std::min(run, stress.size() - 1)];
}

HydrostaticBranch branch_of(const Case& c, const LaboratoryTest& test, std::size_t run) {
  double pressure = test.pressure == PressureRole::lateral ? c.test.confinement[run] : 0.0;
  if (const double other = intermediate_of(c, run); other > 0.0)
    pressure = (pressure + 2.0 * other) / 3.0;  // mean
  return {pressure > 0.0 ? c.test.hydrostatic_branch : HydrostaticResponse::law, pressure};
}

}  // namespace

Material material_of_run(const Case& c, const LaboratoryTest& test, std::size_t run,
                         const AreaFactor& factor) {
  return with_bond_limits(c.materials[run], branch_of(c, test, run), factor.alpha, factor.fabric);
}

std::vector<BondMaterial> materials_of_groups(const Case& c, const LaboratoryTest& test, std::size_t run,
                                              const AreaFactor& factor,
                                              std::span<const AreaFactor> group_factors) {
  std::vector<BondMaterial> materials;
  for (std::size_t k = 0; k < c.groups.size(); ++k) {
    BondMaterial m{
        with_bond_limits(c.groups[k].materials[run], branch_of(c, test, run), factor.alpha, factor.fabric),
        group_factors[k].shear_ratio};
    // all bonds share one factor on their areas: what another would do to the stiffness, E does
    m.material.young_modulus *= group_factors[k].alpha / factor.alpha;  // (B125)
    materials.push_back(std::move(m));
  }
  return materials;
}

LoadTest load_test(const Case& c, const LaboratoryTest& test, std::size_t run, const AreaFactor& factor) {
  LoadTest load;
  load.loading = test.loading;
  load.confinement = c.test.confinement[run];
  load.intermediate = intermediate_of(c, run);
  const HydrostaticBranch branch = branch_of(c, test, run);
  load.hydrostatic_response = branch.response;
  if (branch.response == HydrostaticResponse::elastic)
    load.limits_raised = hydrostatic_bond_stress(branch.pressure, factor.alpha, factor.fabric);
  load.platen_speed = c.test.platen_speed;
  load.stop_strain = c.test.stop_strain;
  load.stop_after_peak = c.test.stop_after_peak;
  load.frames = c.frames;
  load.unload_at = c.test.unload_at;
  load.unload_to = c.test.unload_to;
  return load;
}

WorldOptions world_options(const Case& c, const LaboratoryTest& test, const Features& asked, int threads) {
  WorldOptions o;
  o.features = asked;
  o.new_contacts = c.features.new_contacts;
  o.search_every = c.search_every.value_or(0);
  o.rough_platens = test.always_rough || c.test.rough_platens;
  o.rigid_sides = test.rigid_sides;
  if (test.loading == Loading::cutting) {
    const double degree = std::numbers::pi / 180.0;
    o.cutting = {c.test.cut_depth.value_or(0.0), c.test.cut_width.value_or(0.0), degree * c.test.rake_angle,
                 degree * c.test.clearance_angle, c.test.tool_friction};
  }
  o.skin_weights = c.test.skin_weights;
  o.current_surface = c.test.current_surface;
  o.cracks = c.cracks;
  o.orientation = c.orientation;
  o.contact_damping = c.damping.contact;
  o.paper_form = c.damping.paper_form;
  o.damping_scheme = c.damping.scheme;
  o.global_damping = {c.damping.translation, c.damping.rotation};
  if (const auto rate = c.damping.viscous_rate) o.global_damping = {*rate, *rate, true};
  o.safety = c.safety;
  if (c.mass_scaling) o.mass_factor = c.mass_factor;
  o.scatter = c.scatter;
  o.precision = c.precision;
  o.ledger = c.features.energy_ledger;
  o.threads = threads;
  return o;
}

}  // namespace breccia
