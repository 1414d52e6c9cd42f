// What several tests share: the same material for the fast code and for the reference, bodies made
// by hand, small packings, and the whole state of a world handed over to the reference.
#pragma once
#include <algorithm>
#include <map>
#include <numbers>
#include <set>
#include <vector>

#include "core/bonding/law_of_material.hpp"
#include "core/packing/packing.hpp"
#include "core/stepping/step.hpp"
#include "core/world/loop_views.hpp"
#include "core/world/make_world.hpp"
#include "core/world/world.hpp"
#include "kernels/loops/contact_pass.hpp"
#include "tests/reference/reference.hpp"

namespace breccia::scene {

inline Material material_of(const reference::Parameters& p) {
  Material m;
  m.density = p.density;
  m.young_modulus = p.E;
  m.poisson_ratio = p.nu;
  m.friction_static = p.mu1;
  m.friction_dynamic = p.mu2;
  m.tensile_strength = p.sigma_t;
  m.shear_strength = p.tau_f;
  m.limit_compressive_stress = p.LCS;
  m.stiffness_reduction = p.YRC;
  m.damage_normal = p.delta_n;
  m.damage_shear = p.delta_s;
  m.fracture_energy_normal = p.G_I;
  m.fracture_energy_shear = p.G_II;
  m.criterion = static_cast<Criterion>(p.criterion);
  m.unloading_modulus = p.unloads * p.E;
  if (p.yield_stress > 0) m.yield_stress = p.yield_stress;
  m.shear_under_yield = p.shear_follows ? ShearUnderYield::tangent : ShearUnderYield::elastic;
  return m;
}

inline double shear_ratio(const reference::Parameters& p) {
  return p.kappa ? *p.kappa : 1 / (2 * (1 + p.nu));
}
inline DempackLaw law(const reference::Parameters& p) {
  return std::get<DempackLaw>(law_of(material_of(p), shear_ratio(p)));
}
inline Features features(const reference::Parameters& p) {
  return {p.rotation, p.contact_damping, p.plasticity, p.breakage, static_cast<Criterion>(p.criterion)};
}

struct Ball {
  Gid id;
  double radius;
  Vec3 x;
  int group = 1;
  Vec3 v{}, w{};
};

/// Spheres in the order given, nobody held, bonded where the rule says; around the origin.
inline Assembly free_body(const std::vector<Ball>& balls, double beta, const Features& features) {
  Assembly a;
  a.body = {Shape::cylinder, 1.0, 0.0, 1.0};
  ParticleTable& p = a.particles;
  p.resize(balls.size(), features);
  p.free = a.first_top = balls.size();
  for (std::size_t k = 0; k < balls.size(); ++k) {
    p.gid[k] = balls[k].id;
    p.radius[k] = balls[k].radius;
    p.position[k] = p.reference_position[k] = balls[k].x;
    p.velocity[k] = balls[k].v;
    if (features.rotation) p.spin[k] = balls[k].w;
    a.mean_radius += balls[k].radius / double(balls.size());
  }
  std::vector<std::pair<Row, Row>> links;
  for (Row i = 0; i < balls.size(); ++i)
    for (Row j = i + 1; j < balls.size(); ++j)
      if (balls[i].group != 0 && balls[i].group == balls[j].group &&
          norm(balls[j].x - balls[i].x) <= (1 + beta) * (balls[i].radius + balls[j].radius))
        links.push_back(balls[i].id < balls[j].id ? std::pair(i, j) : std::pair(j, i));
  BondTable& b = a.bonds;
  b.resize(links.size(), features, bond_batch);
  for (std::size_t k = 0; k < b.padded; ++k) {
    const auto [lo, hi] = links[std::min(k, links.size() - 1)];
    b.gid_lo[k] = p.gid[lo], b.gid_hi[k] = p.gid[hi];
    b.row_lo[k] = lo, b.row_hi[k] = hi;
    b.rest_length[k] = norm(p.position[hi] - p.position[lo]);
    const double smaller = std::min(p.radius[lo], p.radius[hi]);
    b.area[k] = k < b.size ? std::numbers::pi * smaller * smaller : 0.0;
  }
  a.range = beta;
  return a;
}

inline WorldOptions options(const reference::Parameters& p) {
  WorldOptions o;
  o.features = built_features(law(p), features(p));
  o.new_contacts = p.unbonded_contacts;
  o.contact_damping = p.xi;
  o.global_damping = {p.damping_translation, p.damping_rotation};
  return o;
}

inline AreaFactor factor(const reference::Parameters& p) {
  AreaFactor f;
  f.alpha = p.alpha;
  f.shear_ratio = shear_ratio(p);
  return f;
}

/// Two spheres of radius 1 m, one upon the other, both held: the pair of the Kratos benchmarks 22
/// and 24.
inline World kratos_pair(reference::Parameters p, double dt) {
  p.E = 1e9;
  p.sigma_t = 1e6;
  p.tau_f = 0.5e6;
  p.plasticity = p.contact_damping = false;
  p.xi = 0;
  Assembly a = free_body({{140, 1, {0, 0, -1}}, {141, 1, {0, 0, 1}}}, p.beta, options(p).features);
  a.particles.free = 0, a.first_top = 1;
  World w = make_world(a, material_of(p), factor(p), options(p));
  w.dt = dt;
  return w;
}

/// A cylinder 100 mm high and 50 mm across.
inline const Body& small_cylinder() {
  static const Body body{Shape::cylinder, 0.05, 0, 0.10};
  return body;
}

/// Packed once, with seed 1.
inline const Specimen& small_packing(std::size_t spheres) {
  static std::map<std::size_t, Specimen> made;
  const auto [at, is_new] = made.try_emplace(spheres);
  if (is_new) {
    PackRequest r;
    r.spheres = spheres;
    at->second = pack_spheres(small_cylinder(), r);
  }
  return at->second;
}

/// The same scene for the reference, at step 0 of a world; rows are the same.
/// @param group  cohesive group of each row
inline reference::World to_reference(const World& w, const reference::Parameters& parameters,
                                     const std::vector<int>& group = {}) {
  reference::World r;
  r.parameters = parameters;
  const ParticleTable& p = w.particles;
  for (std::size_t k = 0; k < p.size; ++k) {
    reference::Particle a = reference::sphere(parameters, std::int64_t(p.gid[k]), p.radius[k], p.position[k],
                                              group.empty() ? 1 : group[k]);
    a.v = p.velocity[k];
    if (!p.spin.empty()) a.w = p.spin[k];
    a.held.fill(k >= p.free);
    r.particles.push_back(a);
  }
  reference::make_bonds(r);
  return r;
}

/// Instruction sets that this processor runs.
inline std::vector<InstructionSet> sets_of_this_machine() {
  std::vector<InstructionSet> sets;
  for (int k = 0; k <= static_cast<int>(best_instruction_set()); ++k)
    sets.push_back(static_cast<InstructionSet>(k));
  return sets;
}

/// Speeds of the lower and the upper platen along z, m/s.
inline void drive(World& w, double lower, double upper) {
  w.platens.velocity = {Vec3{0, 0, lower}, Vec3{0, 0, upper}};
}
/// 150 packed spheres of alpha 0.8, pressed for 150 steps by platens so fast that bonds break where
/// they may.
inline World crushed(const Features& asked) {
  reference::Parameters p;
  p.alpha = 0.8;
  const Assembly a = assemble(small_packing(150), small_cylinder(), {}, built_features(law(p), asked), 1);
  WorldOptions o = options(p);
  o.features = asked;
  World w = make_world(a, material_of(p), factor(p), o);
  for (int k = 0; k < 150; ++k) {
    drive(w, 6, -6);
    advance(w);
  }
  return w;
}

/// Pa, of each platen, positive in compression.
inline std::array<double, 2> platen_stress(const Platens& p) {
  return {-p.force[0].z / p.section, p.force[1].z / p.section};
}

/// Forces and torques that the next step will see, without moving anything.
struct Forces {
  std::vector<Vec3> force, torque;
};
inline Forces forces_now(World w) {  // a copy: history advances
  ParticleTable& p = w.particles;
  Forces f{std::vector<Vec3>(p.size), std::vector<Vec3>(p.spin.empty() ? 0 : p.size)};
  BondTable& b = w.bonds;
  Scatter to;
  to.to_lo = b.row_lo, to.to_hi = b.row_hi, to.arm_offset = b.arm_offset;
  to.force = f.force, to.torque = f.torque;
  w.bond_pass(bond_pass_in(w), bond_pass_history(w), 0, b.padded, to, nullptr);
  ContactTable& c = w.contacts;
  to.to_lo = c.row_lo, to.to_hi = c.row_hi, to.arm_offset = c.arm_offset;
  contact_pass({w.dt, w.shear_ratio, w.friction, w.features.rotation, p.position, p.velocity, p.spin,
                p.radius, c.row_lo, c.row_hi, c.arm_offset, c.stiffness, c.damping},
               {c.free_length, c.shear_force, {}}, 0, c.size, to);
  return f;
}

}  // namespace breccia::scene
