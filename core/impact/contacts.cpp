#include "core/impact/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/geometry/cell_list.hpp"
#include "kernels/laws/restitution.hpp"

namespace breccia {
namespace {

double mean(double a, double b) { return 0.5 * (a + b); }
double harmonic_mean(double a, double b) { return a + b > 0.0 ? 2.0 * a / (a + b) * b : 0.0; }

/// One end of a contact as both laws see it; a wall has no curvature and no inverse mass.
ElasticBody body_of(const ImpactMaterial& m, double radius, double mass) {
  return {m.young_modulus, m.poisson_ratio, radius > 0.0 ? 1.0 / radius : 0.0, mass > 0.0 ? 1.0 / mass : 0.0};
}

/// k_n = E A/d0 and k_s as those of a bond (B30), with harmonic means; a wall is met like a
/// mirror image.
ImpactConstants linear_constants(const ElasticBody& a, const ElasticBody& b,
                                 const std::optional<double>& stiffness, double xi) {
  const double curvature = std::max(a.curvature, b.curvature);  // of the smaller sphere
  const double other = b.curvature > 0.0 ? std::min(a.curvature, b.curvature) : curvature;
  const double area = std::numbers::pi / (curvature * curvature);
  const double normal =
      stiffness.value_or(harmonic_mean(a.young, b.young) * area / (1.0 / curvature + 1.0 / other));
  const double ratio = 0.5 / (1.0 + harmonic_mean(a.poisson, b.poisson));
  // (S3.8)
  return {normal, ratio * normal, 2.0 * xi * std::sqrt(normal / (a.inverse_mass + b.inverse_mass))};
}

ImpactConstants constants_of(const ImpactScene& scene, const ImpactMaterial& one, const ImpactMaterial& other,
                             const ElasticBody& a, const ElasticBody& b) {
  const double e = mean(one.restitution, other.restitution);
  const bool pulls = scene.law == ContactLaw::hertz_mindlin && scene.form == HertzForm::classic;
  const double xi = pulls ? damping_of_restitution_with_pull(e) : damping_of_restitution(e);
  ImpactConstants c;
  if (scene.law == ContactLaw::linear) {
    c = linear_constants(a, b, scene.stiffness, xi);
  } else {
    const HertzMindlin h = hertz_mindlin(a, b, xi, 0.0);
    c = {h.normal, h.tangential, h.damping};
  }
  c.friction = mean(one.friction, other.friction);
  c.lever = mean(one.rolling_friction, other.rolling_friction) / (a.curvature + b.curvature);
  return c;
}

struct Candidate {
  Row row, partner;
  auto operator<=>(const Candidate&) const = default;
};

/// Gives a list its new rows; those that were there keep what they remember.
template <class Constants>
void renew_list(ImpactContactTable& table, const std::vector<Candidate>& candidates, Constants&& constants) {
  const ImpactContactTable before = std::move(table);
  table = ImpactContactTable{};
  table.resize(candidates.size(), Features{});
  std::size_t old = 0;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const Candidate& pair = candidates[k];
    table.row[k] = pair.row;
    table.partner[k] = pair.partner;
    const ImpactConstants c = constants(pair);
    table.normal[k] = c.normal;
    table.tangential[k] = c.tangential;
    table.damping[k] = c.damping;
    table.friction[k] = c.friction;
    table.lever[k] = c.lever;
    while (old < before.size && Candidate{before.row[old], before.partner[old]} < pair) ++old;
    if (old == before.size || Candidate{before.row[old], before.partner[old]} != pair) continue;
    table.overlap[k] = before.overlap[old];
    table.shear_force[k] = before.shear_force[old];
    table.rolling[k] = before.rolling[old];
  }
}

}  // namespace

double mass_of(const ImpactScene& scene, const ImpactParticle& p) {
  return scene.materials[p.material].density * 4.0 / 3.0 * std::numbers::pi * p.radius * p.radius * p.radius;
}

ImpactConstants pair_constants(const ImpactScene& scene, std::size_t i, std::size_t j) {
  const ImpactParticle &a = scene.particles[i], &b = scene.particles[j];
  const ImpactMaterial &one = scene.materials[a.material], &other = scene.materials[b.material];
  return constants_of(scene, one, other, body_of(one, a.radius, mass_of(scene, a)),
                      body_of(other, b.radius, mass_of(scene, b)));
}

ImpactConstants wall_constants(const ImpactScene& scene, std::size_t i, std::size_t material) {
  const ImpactParticle& a = scene.particles[i];
  const ImpactMaterial &one = scene.materials[a.material], &other = scene.materials[material];
  return constants_of(scene, one, other, body_of(one, a.radius, mass_of(scene, a)), body_of(other, 0, 0));
}

ContactSlopes slopes_at(ContactLaw law, const ImpactConstants& c, double overlap) {
  if (law == ContactLaw::linear) return {c.normal, c.tangential, c.damping, 0.0};
  const double root = std::sqrt(overlap), slope = 1.5 * c.normal * root, across = c.tangential * root;
  return {slope, across, c.damping * std::sqrt(slope), c.damping * std::sqrt(across)};
}

double step_demand(const ContactSlopes& s, double dt) {
  const auto one = [&](double k, double c) { return 0.25 * dt * dt * k + 0.5 * dt * c; };
  return std::max(one(s.normal, s.damping), rolling_factor * one(s.tangential, s.tangential_damping));
}

bool rebuild_is_due(const ImpactSearch& search, const ParticleTable& p) {
  if (search.position.empty() || 2.0 * search.walls_moved >= search.skin) return true;
  const double most = 0.25 * search.skin * search.skin;
  for (std::size_t row = 0; row < p.size; ++row) {
    const Vec3 moved = p.position[row] - search.position[row];
    if (!(dot(moved, moved) < most)) return true;
  }
  return false;
}

double reach_of(const WallMotion& motion, double time, std::span<const Vec3> position,
                std::span<const double> radius) {
  const Vec3 centre = centre_at(motion, time);
  double reach = 0.0;
  for (std::size_t k = 0; k < position.size(); ++k)
    reach = std::max(reach, norm(position[k] - centre) + radius[k]);
  return reach;
}

void renew_contacts(ImpactSearch& search, const ImpactScene& scene, std::span<const Wall> placed, double time,
                    const ParticleTable& p, ImpactContactTable& pairs, ImpactContactTable& walls) {
  search.position = p.position.copy();
  ++search.rebuilds;
  search.wall_speed = search.walls_moved = 0.0;
  for (const ImpactWall& wall : scene.walls) {
    if (!wall.motion.moves()) continue;
    // points farther out meet no particle before the next list
    const double reach = reach_of(wall.motion, time, search.position, p.radius) + 8.0 * search.skin;
    search.wall_speed = std::max(search.wall_speed, surface_speed(wall.shape, wall.motion, reach));
  }
  std::vector<Candidate> near;
  for (const auto& [a, b] : near_pairs(p.position, p.radius, 0.0, search.skin, scene.threads))
    near.push_back({a, b});
  std::sort(near.begin(), near.end());
  renew_list(pairs, near, [&](const Candidate& c) { return pair_constants(scene, c.row, c.partner); });

  near.clear();
  for (std::size_t row = 0; row < p.size; ++row)
    for (std::size_t wall = 0; wall < scene.walls.size(); ++wall)
      if (clearance(placed[wall], p.position[row]) < p.radius[row] + search.skin)
        near.push_back({static_cast<Row>(row), static_cast<Row>(wall)});
  renew_list(walls, near, [&](const Candidate& c) {
    return wall_constants(scene, c.row, scene.walls[c.partner].material);
  });
}

}  // namespace breccia
