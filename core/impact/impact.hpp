// Free particles that meet each other and walls: the scene, what is measured, and the run.
// docs/model.md, "Unbonded contacts".
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/geometry/wall_motion.hpp"
#include "core/tables/particle_table.hpp"
#include "kernels/laws/hertz_mindlin.hpp"

namespace breccia {

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
  double overlap = 0;        ///< 1, part of a radius that it may overlap others and walls at the start
};

struct ImpactWall {
  Wall shape;                ///< at time 0
  std::size_t material = 0;  ///< of ImpactScene::materials
  WallMotion motion{};
  std::size_t name = 0;  ///< of ImpactScene::wall_names
  double load = 0;       ///< N, a weight that presses a plane along its normal; it gives way
  double mass = 0;       ///< kg, of a plane with a load
};

/// Friction, restitution and rolling friction of two different materials are their arithmetic
/// means.
struct ImpactScene {
  std::vector<ImpactMaterial> materials;
  std::vector<ImpactParticle> particles;  ///< that of row k has the global id k + 1
  std::vector<ImpactWall> walls;
  std::vector<std::string> wall_names;  ///< what forces on walls are summed by
  ContactLaw law = ContactLaw::hertz_mindlin;
  HertzForm form = HertzForm::dissipative;
  RollingModel rolling = RollingModel::elastic_plastic;
  std::optional<double> stiffness;  ///< N/m, k_n of the linear law instead of E A/(r_i + r_j)
  Vec3 gravity;                     ///< m/s^2
  double duration = 0;              ///< s
  double safety = 0.002;            ///< of the critical step
  int rows = 1000;                  ///< of the curve, about
  int frames = 0;                   ///< pictures of the particles, evenly over the run
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

/// What the walls of one name take up. Torque about the centre of their motion.
struct WallLoad {
  Vec3 force, torque;  ///< N, N m, on the walls
  double work = 0;     ///< J, that they have done on the particles
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
  std::vector<std::vector<WallLoad>> wall_rows;  ///< of each row, by name: means of the steps since the last
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

/// What a run calls on its way.
struct ImpactWatch {
  std::function<bool(double time)> interrupted{};  ///< now and then; true ends the run
  std::function<void(const ParticleTable&, int number, double time)>
      frame{};  ///< ImpactScene::frames of them
};

/// Runs a scene from start to end. `result` holds what there is when it throws.
/// @throws BadInput as above; SimulationBroke: not a number, an overlap beyond half a radius, more
///         or deeper contacts than the step allows
void run_impact(const ImpactScene& scene, ImpactResult& result, const ImpactWatch& watch = {});

}  // namespace breccia
