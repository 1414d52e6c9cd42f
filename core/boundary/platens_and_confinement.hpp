// What acts on a specimen from outside: two platens, and what surrounds its lateral surface.
// docs/model.md, "Laboratory tests".
#pragma once
#include <array>
#include <vector>

#include "core/bonding/assembly.hpp"
#include "core/ranks/partition.hpp"

namespace breccia {

/// The lower and the upper platen: the two bodies of held particles (layers, strips, halves of a
/// shear box).
struct Platens {
  bool rough = true;               ///< lateral motion prescribed too
  bool servo = false;              ///< driven along z by a pressure instead of at a given speed
  double section = 0;              ///< m^2, by which reactions become stresses
  double pressure = 0;             ///< Pa, wanted of a servo
  std::array<double, 2> mass{};    ///< kg, of the layers: the rigid bodies that a servo moves
  double servo_part = 1;           ///< of that mass, which a servo has to move
  double dashpot = 0;              ///< N s/m, holds back a servo
  std::array<Vec3, 2> velocity{};  ///< m/s, half a step before position
  std::array<Vec3, 2> travel{};    ///< m, since the start
  std::array<Vec3, 2> force{};     ///< N, of the specimen on each
  double work = 0;                 ///< J, that both have done on the specimen
};

/// Pa, positive in compression, mean of both ends. (B74)
inline double axial_stress(const Platens& p) { return 0.5 * (p.force[1].z - p.force[0].z) / p.section; }
/// Pa, top against bottom: what is missing to balance. (B74)
inline double mismatch(const Platens& p) { return std::abs(p.force[1].z + p.force[0].z) / p.section; }
/// Pa, with which the specimen holds back the upper body against the lower one along x. (B80)
inline double shear_stress(const Platens& p) { return 0.5 * (p.force[0].x - p.force[1].x) / p.section; }
/// m, towards each other.
inline double approach(const Platens& p) { return p.travel[0].z - p.travel[1].z; }
/// m, of the upper against the lower along x.
inline double shear_travel(const Platens& p) { return p.travel[1].x - p.travel[0].x; }

/// @param particles      with their masses
/// @param young_modulus  Pa, of the specimen
Platens make_platens(const Assembly& assembly, const ParticleTable& particles, bool rough,
                     double young_modulus);

/// Reactions of this step, and for a servo the velocity that follows from them.
/// @param behind  N, along z: of planes behind the layers on the specimen
void drive_platens(Platens& platens, const ParticleTable& particles, const Partition& partition,
                   std::size_t first_top, const std::array<double, 2>& behind, double dt);

/// What surrounds the lateral surface: a fluid under pressure, forces p w on each of its particles
/// with weights w that add up to the nominal surface; or a rigid wall that lets it slide along the
/// axis only.
struct Confinement {
  bool rigid = false;     ///< x and y of the lateral surface are fixed
  bool plane = false;     ///< two dimensions: the lateral surface is two sides, normal to x
  bool prism = false;     ///< a box: the lateral surface is four faces
  double pressure = 0;    ///< Pa, asked for now; of a rigid wall the mean reaction
  double pressure_x = 0;  ///< Pa, of a box on its faces normal to x; `pressure` on those normal to y
  double acting = 0;   ///< Pa, inward forces of this step over the nominal surface; of a rigid wall the same
  double surface = 0;  ///< m^2, nominal
  double surface_y = 0;  ///< m^2, nominal, of a box its faces normal to y
  bool current = false;  ///< pressure acts on the surface as it is now
  double grown = 1;      ///< of the surface, by what it has become larger; 1 where it does not count
  double height = 0;     ///< m, of the specimen when it was made
  double impedance = 0;  ///< Pa s/m, sqrt(E rho) of the specimen: what a box's faces can follow; 0: anything
  std::vector<Row> rows;
  std::vector<double> weight;    ///< m^2; of a box on a face normal to y, 0 where it is on none
  std::vector<double> weight_x;  ///< m^2, of a box on a face normal to x
  std::vector<Vec3> force;       ///< N, of this step
  std::vector<char> drifts;      ///< nothing but the pressure acts on it in this step (B112)
  std::vector<Row> flying;       ///< of this rank: others on which nothing acts, and that the fluid
  std::vector<Vec3> brake;       ///< N, holds back in this step

  bool acts() const { return pressure != 0.0 || pressure_x != 0.0; }
};

/// @param rigid  a wall instead of a fluid
Confinement make_confinement(const Assembly& assembly, SkinWeights weights, bool rigid);

/// What the spheres of the lateral surface cover of it, as disks (discs: as lines) as wide as they
/// are: 0.65 to 0.9 of the nominal surface in packings. They stand for the whole of it, so that the
/// fewer they are, the harder each is pressed.
double lateral_cover(const Assembly& assembly);

/// True where a lateral direction has no meaning for the whole surface: all of it lies on the axis.
bool is_one_sphere_wide(const Assembly& assembly);

/// What the lateral surface has become: its height by the platens' travel, its width by the least
/// squares of its spheres' places (B115).
void measure_surface(Confinement& confinement, const ParticleTable& particles, const Partition& partition,
                     const Platens& platens);

/// Adds the pressure forces; their net force and moment are removed by a least-squares correction.
/// A sphere on the axis has no lateral direction and gets no force; one at an edge of a box is
/// pressed on both faces.
void apply_confinement(Confinement& confinement, ParticleTable& particles, const Partition& partition);

/// A rigid wall takes up the lateral forces of the lateral surface, all of them summed: called when
/// they are complete. (B73)
void restrain_laterally(Confinement& confinement, ParticleTable& particles, const Partition& partition);

}  // namespace breccia
