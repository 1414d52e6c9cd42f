#include "core/studies/layouts/operation_count.hpp"

#include "kernels/laws/bond_force.hpp"
#include "kernels/laws/dempack.hpp"
#include "kernels/single/pair_motion.hpp"

namespace breccia {
namespace {

/// Strengths of a concrete, so that a stretch of 1e-6 is far below all of them.
DempackLaw concrete() {
  Material m;
  m.young_modulus = 30e9;
  m.friction_static = 0.4, m.friction_dynamic = 0.4;
  m.tensile_strength = 3e6, m.shear_strength = 10e6;
  m.limit_compressive_stress = {20e6, 45e6, 57e6};
  m.stiffness_reduction = {3, 12, 22};
  m.damage_normal = m.damage_shear = 1.0;
  return DempackLaw::of(m, 0.3);
}

}  // namespace

OperationCount operations_per_bond() {
  const DempackLaw law = concrete();
  const double radius = 5e-3, area = 7e-5, length = 2 * radius, dt = 1e-6;
  const BondConstants<Counted> bond{length, area, area, law.young * area / length, 10.0};
  const End<Counted> lo{{0, 0, 0}, {1e-3, 0, 0}, {0, 0.1, 0}},
      hi{{0, 0, length * (1 + 1e-6)}, {0, 1e-3, 0}, {0.1, 0, 0}};
  BondHistory<Counted> history{{0.1, 0.1, 0}, 0, 0, 0};
  Vec<Counted> force_lo, force_hi, torque_lo, torque_hi;
  const Counted arm_offset = 0.1;
  return operations_of([&] {
    const Pair<Counted> pair = relative_motion<true>(ends_of(lo, hi), arm_offset, dt);
    const Vec<Counted> force = bond_force<Features{}>(law, bond, pair, history);
    const Vec<Counted> moment = pair.distance * cross(pair.normal, force);
    force_lo += force, force_hi -= force;
    torque_lo += (Counted(0.5) + arm_offset) * moment;
    torque_hi += (Counted(0.5) - arm_offset) * moment;
  });
}

OperationCount single_operations_per_bond() {
  const DempackLaw law = concrete();
  const double quantum = 0x1p-43, length = 1e-2 / quantum, area = 7e-5;
  const EndColumns<Counted> ends{
      {0, 0, 1e-6 * length}, {1, 0, 1}, {0, 1, 0}, {0, 0, std::round(length / coarse_parts)}};
  const Counted per_radii = 1 / length, finer = 0.25, plastic = 0;
  const BondConstants<Counted> bond{length, area, area, law.young * area / length, 10.0};
  const Vec<Counted> before{0.1, 0.1, 0};
  return operations_of([&] {
    const PairMotion<Counted> pair = motion_of(ends, per_radii, finer);
    const Vec<Counted> shear = trial_shear<true>(pair, before, law.shear_ratio * bond.stiffness);
    const Counted elastic = pair.longer - plastic, normal = bond.stiffness * elastic;
    const Counted total = normal + bond.damping * pair.rate;
    (void)may_yield(law, bond, elastic, elastic);
    (void)may_fail<false>(law.failure, limits_of(law, bond), normal, dot(shear, shear));
    (void)force_of(pair, total, shear);
    (void)moment_of(pair, shear);
  });
}

}  // namespace breccia
