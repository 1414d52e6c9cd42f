// The largest stable step of a small network to seven digits, in another way than time_step.hpp:
// what its estimate is held against.
#pragma once
#include "core/world/world.hpp"

namespace breccia {

/// The scheme is stable while 1/(1 + alpha) - M^-1/2 (dt^2 K/4 + dt C/2) M^-1/2 is positive
/// definite (B41), which its Cholesky factorisation tells: bisection on dt with dense matrices. All
/// particles free, bonds intact and pressed, contacts left out.
/// @param world  of some hundred particles at most: memory grows with the square of their number
/// @returns s; infinite for a world without bonds
double exact_time_step(const World& world);

}  // namespace breccia
