// Energies of a world, entered into its ledger step by step, and what they add up to.
#pragma once
#include "core/world/world.hpp"

namespace breccia {

/// Work of a force from outside over the two half steps around it, J.
struct OuterWork {
  double over_this = 0, over_next = 0;
  OuterWork& operator+=(const OuterWork& o) {
    over_this += o.over_this, over_next += o.over_next;
    return *this;
  }
};

/// What walls and the pressure do in this step.
struct OuterWorks {
  OuterWork walls, pressure;
};

/// Once forces are complete, before velocities are kicked.
OuterWorks works_from_outside(const World& world);

/// Of kicks, J: also what platens do; and what else comes of moving particles.
struct StepWork : Integrated {
  double held_this = 0, held_next = 0;  ///< by platens
  StepWork& operator+=(const StepWork& o) {
    kinetic += o.kinetic, held_this += o.held_this, held_next += o.held_next;
    motion_this += o.motion_this, motion_next += o.motion_next;
    spin_this += o.spin_this, spin_next += o.spin_next;
    gauge += o.gauge, events |= o.events;
    return *this;
  }
};

/// Kicks and drifts the rows that move freely. Where there is a ledger these are booked, and those
/// that platens are about to move: one way through the particles for all of it.
StepWork move_free(World& world);

/// Enters a step whose particles have moved.
void enter_step(World& world, const StepWork& work, const OuterWorks& outer);

/// At the end of the last step, of all ranks.
EnergyBalance energy_balance(const World& world);

}  // namespace breccia
