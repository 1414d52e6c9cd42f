// What acts on a specimen from outside: two platens and the pressure of a fluid on its mantle. MODEL
// section 10.
#pragma once
#include <array>
#include <vector>

#include "core/assembly.hpp"

namespace breccia {

/// The lower and the upper platen: layers of held particles.
struct Platens {
  bool rough = true;
  bool servo = false;                ///< driven by the pressure of the fluid instead of at a given speed
  double section = 0;                ///< m^2
  double pressure = 0;               ///< Pa, wanted of a servo
  std::array<double, 2> mass{};      ///< kg, of the layers: the rigid bodies that a servo moves
  double dashpot = 0;                ///< N s/m, holds back a servo
  std::array<double, 2> velocity{};  ///< m/s along z, half a step before position
  std::array<double, 2> travel{};    ///< m, towards each other
  std::array<double, 2> stress{};    ///< Pa, reaction over section, positive in compression
};

/// @param particles      with their masses
/// @param young_modulus  Pa, of the specimen
Platens make_platens(const Assembly& assembly, const ParticleTable& particles, bool rough,
                     double young_modulus);

/// Reactions of this step, and for a servo the velocity that follows from them.
void drive_platens(Platens& platens, const ParticleTable& particles, std::size_t first_top, double dt);

/// Fluid pressure on the mantle: radial forces of p pi r^2 s, s such that the weights add up to the nominal
/// surface.
struct Confinement {
  double pressure = 0;  ///< Pa, now
  std::vector<Row> rows;
  std::vector<double> weight;  ///< m^2
  std::vector<Vec3> force;     ///< N, of this step
};

Confinement make_confinement(const Assembly& assembly);

/// Adds the pressure forces; their net force and moment are removed by a least-squares correction.
void press_skin(Confinement& confinement, ParticleTable& particles);

}  // namespace breccia
