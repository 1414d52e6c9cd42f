// One pass over a range of candidate contacts; most of them are apart and cost a distance.
#pragma once
#include <span>

#include "kernels/laws/bond_laws.hpp"
#include "kernels/laws/surface_contact.hpp"
#include "kernels/loops/scatter.hpp"

namespace breccia {

/// What contacts take up and do not give back, J: docs/model.md, "Energy ledger".
struct ContactLosses {
  double viscous = 0, friction = 0;
};

struct ContactPassIn {
  double dt = 0;                                  ///< s
  std::span<const double> shear_ratio, friction;  ///< k_s/k_n and mu_2: one, or by law
  bool rotation = true;
  Strided<const Vec3> position, velocity, spin;
  std::span<const double> radius;
  std::span<const Index> row_lo, row_hi;
  std::span<const double> arm_offset, stiffness,
      damping;                         ///< arm_offset empty without rotation, damping may be
  std::span<const LawIndex> law = {};  ///< of several materials
  std::span<const double> hertz_normal = {}, hertz_tangential = {};  ///< empty: linear
};

struct ContactPassHistory {
  std::span<double> free_length;
  std::span<Vec3> shear_force;
  std::span<double> viscous_force;       ///< empty where the scene has no ledger
  std::span<ContactLosses> losses = {};  ///< J, since the start, a sum for each 64 contacts
};

void contact_pass(const ContactPassIn& in, const ContactPassHistory& history, std::size_t first,
                  std::size_t last, const Scatter& to);

}  // namespace breccia
