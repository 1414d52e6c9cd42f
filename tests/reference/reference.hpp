// The slow, readable solver: docs/model.md as a program. Serial, an array of structs, spheres only,
// one material. Every fast kernel is held against it, so nothing here is shared with them but the
// vector type. Signs: tension positive; pair quantities are j minus i; forces are on i.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "kernels/math/vec3.hpp"

namespace breccia::reference {

enum class Criterion { uncoupled, coupled, mohr_coulomb };
enum class Broken { no, tension, shear };

/// Material, damping and toggles of a world. SI.
struct Parameters {
  double density = 2500;
  double E = 28e9;
  double nu = 0.2;
  std::optional<double> kappa;  ///< k_s/k_n; absent: 1/(2 (1 + nu))
  double mu1 = 0.9;             ///< growth of shear strength with pressure
  double mu2 = 0.25;            ///< Coulomb friction after failure and of contacts
  double sigma_t = 5e6;         ///< Pa
  double tau_f = 16e6;          ///< Pa
  std::array<double, 3> LCS{20e6, 45e6, 70e6};
  std::array<double, 3> YRC{3, 12, 22};
  double delta_n = 0.2, delta_s = 0.2;
  std::optional<double> G_I, G_II;                       ///< J/m^2; present: they replace delta_n, delta_s
  double xi = 0.9;                                       ///< contact damping, fraction of critical
  double damping_translation = 0, damping_rotation = 0;  ///< global, non-viscous
  Criterion criterion = Criterion::uncoupled;
  double unloads = 1;         ///< k_u/k_n of a bond that has yielded
  double yield_stress = 0;    ///< Pa, where plasticity begins; below LCS[0]: there
  bool shear_follows = true;  ///< k_s falls as k_n does while compression yields
  double alpha = 1.0;         ///< factor on contact areas
  double beta = 0.10;         ///< bonding range
  bool rotation = true, plasticity = true, breakage = true, contact_damping = true, unbonded_contacts = true;
};

struct Particle {
  std::int64_t id = 0;
  double radius = 0, mass = 0, inertia = 0;
  int group = 0;       ///< 0: bonds with nobody
  Vec3 x;              ///< at n
  Vec3 v, w;           ///< at n - 1/2
  Vec3 force, torque;  ///< at n, external part and contact damping in, global damping out
  Vec3 external_force, external_torque;
  std::array<bool, 3> held{};  ///< prescribed translation: that component of v stays as it is
};

struct Bond {
  std::size_t i = 0, j = 0;  ///< rows of the particles, the lower id first
  double d0 = 0;             ///< distance at bonding
  double strain_length = 0;  ///< d0, or the floor for nested spheres: k_n and strains use it
  double area = 0, k_n = 0, k_s = 0, c_n = 0, delta_n = 0, delta_s = 0;
  // history
  double u_p = 0;           ///< plastic stretch, <= 0
  double D_n = 0, D_s = 0;  ///< damage; the one of the failure mode becomes 1 (coupled: equal while intact)
  Vec3 F_s;                 ///< k_s times secant shear displacement while intact, friction force once broken
  Broken broken = Broken::no;
  // forces of the last update, on i
  double normal_force = 0;  ///< the law's, tension positive
  double normal_total = 0;  ///< with contact damping
  Vec3 shear_force;         ///< what acts: g(D) F_s while intact, F_s once broken
};

/// An unbonded pair. The record lives from first touch (or from the start) until the spheres have
/// parted.
struct Contact {
  double free_length = 0;  ///< r_i + r_j, or the initial distance of a pair that overlapped then
  Vec3 F_s;
  double normal_force = 0, normal_total = 0;
};

using Pair = std::pair<std::size_t, std::size_t>;  ///< rows, the lower id first

struct World {
  Parameters parameters;
  std::vector<Particle> particles;
  std::vector<Bond> bonds;  ///< sorted by the ids of their ends
  std::map<Pair, Contact> contacts;
};

/// A sphere of the material's density, at rest.
Particle sphere(const Parameters&, std::int64_t id, double radius, Vec3 x, int group = 1);

/// A new bond between two particles at rows i and j; the order of the ends does not matter.
Bond make_bond(const Parameters&, const std::vector<Particle>&, std::size_t i, std::size_t j);

/// Bonds every pair of one group within reach, and gives unbonded overlaps their stress-free
/// length.
void make_bonds(World&);

/// The law of one bond: its history and forces (without damping) at stretch u.
/// @param longer   elongation of this step
/// @param carried  F_s of the last step, turned with the bond
/// @param du       tangential displacement of this step
void bond_law(const Parameters&, Bond&, double u, double longer, const Vec3& carried, const Vec3& du);

/// Law, contact damping and the pair's forces and torques, added to the two particles.
void update_bond(const Parameters&, Bond&, Particle& i, Particle& j, double dt);

/// Forces of the whole world at x(n), v(n - 1/2).
void compute_forces(World&, double dt);

/// compute_forces, global damping, kick, drift.
void step(World&, double dt);

/// A place on a prescribed path of one bond along x: stretch d - d0, and tangential displacement of
/// j against i.
struct PathPoint {
  double u = 0, y = 0, z = 0;
};

/// The bond after each point of the path, which starts at {0, 0, 0}.
std::vector<Bond> bond_path(const Parameters&, Bond, std::span<const PathPoint>);

/// Sets positions (end of step), velocities and spins of a pair along x so that one step goes from
/// one point to the next.
void place_pair(const Bond&, const PathPoint& from, const PathPoint& to, double dt, Particle& i, Particle& j);

}  // namespace breccia::reference
