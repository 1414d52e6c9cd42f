// Free particles that meet each other and walls: the scene, what is measured, and the run.
// docs/model.md, "Unbonded contacts".
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/tables/column.hpp"
#include "kernels/laws/hertz_mindlin.hpp"
#include "kernels/math/wall.hpp"

namespace breccia {

enum class ContactLaw { linear, hertz_mindlin };
enum class RollingModel { constant, elastic_plastic };

/// Of a particle or a wall. SI.
struct ImpactMaterial {
  double density = 0;           ///< kg/m^3; a wall needs none
  double young_modulus = 0;     ///< Pa
  double poisson_ratio = 0;     ///< 1
  double friction = 0;          ///< Coulomb
  double restitution = 1;       ///< 1, rebound over approach speed, above 0
  double rolling_friction = 0;  ///< mu_r: resisting torque over R* F_n
};

struct ImpactParticle {
  Vec3 position;             ///< m
  Vec3 velocity;             ///< m/s, at the start
  Vec3 spin;                 ///< rad/s, at the start
  double radius = 0;         ///< m
  std::size_t material = 0;  ///< of ImpactScene::materials
};

struct ImpactWall {
  Wall shape;
  std::size_t material = 0;
};

/// Friction, restitution and rolling friction of two different materials are their arithmetic
/// means.
struct ImpactScene {
  std::vector<ImpactMaterial> materials;
  std::vector<ImpactParticle> particles;  ///< that of row k has the global id k + 1
  std::vector<ImpactWall> walls;
  ContactLaw law = ContactLaw::hertz_mindlin;
  HertzForm form = HertzForm::dissipative;
  RollingModel rolling = RollingModel::elastic_plastic;
  std::optional<double> stiffness;  ///< N/m, k_n of the linear law instead of E A/(r_i + r_j)
  Vec3 gravity;                     ///< m/s^2
  double duration = 0;              ///< s
  double safety = 0.002;            ///< of the critical step
  int rows = 1000;                  ///< of the curve, about
  int threads = 1;
};

/// One instant. Field names are the columns of curve-0.csv.
struct ImpactRow {
  double time_s = 0;
  double overlap_m = 0;           ///< of the contact that closed first, and its forces
  double normal_force_N = 0;      ///< positive: pressed
  double tangential_force_N = 0;  ///< size
  double kinetic_J = 0;           ///< of all particles, spin included
  double contacts = 0;            ///< pressed at this instant
};

/// What became of one particle.
struct ImpactRecord {
  Gid gid = 0;
  Vec3 position, velocity, spin;  ///< m, m/s, rad/s at the end, all at the same instant
  double largest_overlap = 0;     ///< m
  double largest_force = 0;       ///< N, normal, of one contact
  double contact_time = 0;        ///< s, with one contact or more
};

struct ImpactResult {
  std::vector<ImpactRecord> particles;
  std::vector<ImpactRow> rows;
  std::uint64_t steps = 0, searches = 0;
  double time_step = 0, critical_time_step = 0;  ///< s
  double time = 0;                               ///< s, reached
  double kinetic_before = 0, kinetic_after = 0;  ///< J
  std::size_t open_contacts = 0;                 ///< pressed at the end
  double run_time = 0;                           ///< s, wall
  bool interrupted = false;
};

/// A scene that cannot be run: the key that is wrong, as a case calls it ("particle.position"), and
/// of a list the entry, from 0.
struct BadScene : BadInput {
  BadScene(std::string of, std::size_t in, const std::string& text)
      : BadInput(text), key(std::move(of)), entry(in) {}
  std::string key;
  std::size_t entry = 0;
};

/// @throws BadScene: particles that overlap each other or a wall at the start, or lie behind one
void check_start(const ImpactScene& scene);

/// (B40): the step at which the stiffest contact that can come about goes unstable, s: for Hertz at
/// the overlap of the largest relative speed. A lower bound within 15 % for equal spheres.
/// @throws BadScene when nothing moves and nothing pulls
double critical_impact_step(const ImpactScene& scene);

/// The number of steps of a run.
/// @throws BadScene when there are more than anybody can wait for
double impact_steps(const ImpactScene& scene, double critical_step);

/// Runs a scene from start to end. `result` holds what there is when it throws.
/// @param interrupted  asked now and then; true ends the run
/// @throws BadInput as above; SimulationBroke: not a number, an overlap beyond half a radius, more
///         or deeper contacts than the step allows
void run_impact(const ImpactScene& scene, ImpactResult& result,
                const std::function<bool()>& interrupted = {});

}  // namespace breccia
