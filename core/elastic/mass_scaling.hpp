// Heavier small particles, a larger step: for scenes so slow that inertia does not count.
// docs/model.md, "Time step and mass scaling".
#pragma once
#include <span>

#include "core/tables/particle_table.hpp"

namespace breccia {

struct MassScaling {
  double factor = 1;       ///< total mass over the true one
  std::size_t scaled = 0;  ///< particles that became heavier
};

/// (B47): m_i := max(m_i, (t/dt_i)^2 m_i) with the largest t for which the total mass is at most
/// `factor` times the true one. Inertia follows mass.
/// @param own_steps  s, dt_i, what each particle allows alone
/// @param factor     more than 1
MassScaling scale_masses(ParticleTable& particles, std::span<const double> own_steps, double factor);

}  // namespace breccia
