// Surfaces that touch without a bond: they press from the first step on, so that the elastic probe
// must see them too.
#pragma once
#include <algorithm>
#include <numbers>

#include "core/bonding/assembly.hpp"
#include "core/tables/contact_table.hpp"

namespace breccia {

/// N/m, k_n of a contact.
inline double contact_stiffness(double young_modulus, double alpha, Space space, double r, double s) {
  const double smaller = std::min(r, s);
  return young_modulus * alpha *
         (space == Space::two_d ? 2.0 * smaller : std::numbers::pi * smaller * smaller) / (r + s);
}

struct Touching {
  ContactTable contacts;  ///< with the stiffness of alpha = 1; they press where they are brought nearer
  double friction = 0;
};

/// (B103): pairs without a bond that overlap at the start.
Touching touching_pairs(const Assembly& assembly, double young_modulus, double friction, int threads);

}  // namespace breccia
