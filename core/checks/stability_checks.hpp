// What stops a run that no longer is one: a number that is lost, energy from nowhere, a bond that
// turns too far in a step, a particle that has left. Looked at when a row of the curve is closed: a
// step costs nothing.
#pragma once
#include <vector>

#include "core/world/world.hpp"

namespace breccia {

/// What is remembered from look to look.
struct StabilityChecks {
  Vec3 centre;             ///< m, of the box around the spheres at the start
  double size = 0;         ///< m, its longest edge
  double farthest = 0;     ///< m, largest coordinate
  double fastest = 0;      ///< m/s, what the stiffest bond for its mass carries, see fastest_wave
  double shortest = 0;     ///< m, rest length of a bond
  double accounted = 0;    ///< J, kinetic and stored: what was there and the work since
  double max_energy = 0;   ///< J, the most there ever was
  double noise = 0;        ///< J, that rounding of the coordinates alone stores
  double platen_work = 0;  ///< J, at the last look
  std::vector<Vec3> lateral,
      push;  ///< m, N: places of the lateral surface at the last look, and the pressure on it
};

/// A run whose ledger is out by so much of the work put in has lost its way.
inline constexpr double out_of_balance = 0.1;

/// A specimen as it stands now, with the velocities that it has. Called on every rank.
StabilityChecks make_stability_checks(const World& world);

/// Brings to the root what each rank's checks have noted of its part of the lateral surface.
void gather_surface_marks(StabilityChecks& checks, const World& world);

/// A particle is lost beyond so many times the longest edge of the specimen's box.
inline constexpr double lost_sizes = 10.0;  // (B59)

/// (B58): how many times the energy that can be there may seem to be there. Velocities stand half
/// a step from the places, so that the sum of a mode of frequency w wavers between 1/(1 + s) and
/// 1/(1 - s) of what it is, s = w dt/2: a ratio of (1 + s)/(1 - s) with s the step over the limit,
/// here 2 % below it, and half as much again. Growth is exponential, so that a larger factor costs
/// a blow-up a few steps more.
double allowed_excess(const World& world);

/// Looks at the world after a step. The energy check is a balance whose every loss is allowed:
/// kinetic and stored energy may fall by any amount (a violent failure turns stored energy into
/// kinetic, and both into loss) but rise only by the work of platens and pressure. So it needs no
/// account of what was dissipated.
/// @param kinetic, stored  J, of all particles and bonds
/// @throws SimulationBroke with time, step, particle, bond, likely cause and what to change
void check(StabilityChecks& checks, const World& world, double kinetic, double stored);

}  // namespace breccia
