// The bonds of a scene as a structure of arrays: one record per bond whatever happens to it. `lo`
// is the end with the lower global id, `hi` the other; rows are sorted by the rows of their ends,
// and padded to whole batches of a register with bonds that have no stiffness.
#pragma once
#include <vector>

#include "core/tables/column.hpp"
#include "core/tables/table.hpp"
#include "kernels/loops/bond_pass.hpp"

namespace breccia {

// clang-format off
#define BRECCIA_BOND_COLUMNS(COLUMN)                                                                                  \
  COLUMN(Gid,    gid_lo,          "1",     identity,  always,          "smaller global id of the two ends")           \
  COLUMN(Gid,    gid_hi,          "1",     identity,  always,          "larger global id of the two ends")            \
  COLUMN(Row,    row_lo,          "1",     scratch,   always,          "row of the end gid_lo")                       \
  COLUMN(Row,    row_hi,          "1",     scratch,   always,          "row of the end gid_hi")                       \
  COLUMN(LawIndex, law,           "1",     reference, several,         "which of the scene's laws, one for each pair of materials") \
  COLUMN(double, arm_offset,      "1",     scratch,   rotation,        "(r_lo - r_hi)/(r_lo + r_hi)/2: of the distance, 1/2 + this is the arm of lo, 1/2 - this of hi") \
  COLUMN(double, rest_length,     "m",     reference, always,          "centre distance when bonded; free of stress") \
  COLUMN(double, area,            "m^2",   reference, always,          "alpha times that of the area rule, minimum: pi min(r_lo, r_hi)^2") \
  COLUMN(double, strength_area,   "m^2",   reference, strength_area,   "that strengths stand on, where it is another one") \
  COLUMN(double, stiffness,       "N/m",   reference, always,          "k_n = E area/rest_length")                    \
  COLUMN(double, damping,         "N s/m", reference, contact_damping, "c_n = 2 xi sqrt(m_lo m_hi k_n/(m_lo + m_hi))") \
  COLUMN(double, shear_x,         "N",     history,   always,          "on lo, along x: k_s times the secant shear displacement while intact, the friction force once broken") \
  COLUMN(double, shear_y,         "N",     history,   always,          "the same along y")                            \
  COLUMN(double, shear_z,         "N",     history,   always,          "the same along z")                            \
  COLUMN(double, plastic_stretch, "m",     history,   plasticity,      "elongation at which the bond is free of force, <= 0") \
  COLUMN(double, damage_normal,   "1",     history,   breakage,        "D_n: 0 intact, 1 broken in tension")          \
  COLUMN(double, damage_shear,    "1",     history,   breakage,        "D_s: 0 intact, 1 broken in shear")            \
  COLUMN(Vec3,   couple,          "N m",   history,   rolling,         "moment of cement on lo; resistance to rolling, once broken")    \
  COLUMN(double, spring_force,    "N",     ledger,    ledger,          "of the law along a damaged bond at the end of the step, tension positive") \
  COLUMN(double, viscous_force,   "N",     ledger,    ledger,          "of the dashpot along the bond, as it was applied") \
  COLUMN(double, shear_factor,    "1",     ledger,    ledger,          "of a damaged bond, tangential force over the history of shear")  \
  COLUMN(double, normal_force,    "N",     derived,   stress,          "of the law along the bond, tension positive")  \
  COLUMN(double, normal_stress,   "Pa",    derived,   stress,          "the same over the area")                      \
  COLUMN(double, shear_stress,    "Pa",    derived,   stress,          "magnitude of the tangential force over the area") \
  COLUMN(double, failure_state,   "1",     derived,   stress,          "max(F_s/S, u_e/u_nf), 1 = broken (S5.21)") \
  COLUMN(double, rankine_state,   "1",     derived,   stress,          "of the mean stress of both ends: largest principal stress over sigma_t") \
  COLUMN(double, mohr_coulomb_state, "1",  derived,   stress,          "of the same: radius of the largest circle over that at failure") \
  COLUMN(double, drucker_prager_state, "1", derived,  stress,          "of the same: sqrt(J2) over that at failure")
// clang-format on

struct BondTable {
  BRECCIA_TABLE(BRECCIA_BOND_COLUMNS)
};

/// The areas that strengths stand on.
inline const Column<double>& strength_areas(const BondTable& bonds) {
  return bonds.strength_area.empty() ? bonds.area : bonds.strength_area;
}

/// The columns as the pass over bonds takes them.
inline BondConstantColumns constant_columns(const BondTable& b) {
  return {b.arm_offset, b.area, strength_areas(b), b.stiffness, b.damping};
}
inline BondHistoryColumns history_columns(BondTable& b) {
  return {b.shear_x, b.shear_y, b.shear_z, b.plastic_stretch, b.damage_normal, b.damage_shear};
}

/// What bond `k` is, as a law takes it; without its dashpot, which stores no energy.
inline BondConstants<double> constants_of_bond(const BondTable& bonds, std::size_t k) {
  return {bonds.rest_length[k], bonds.area[k], strength_areas(bonds)[k], bonds.stiffness[k], 0.0};
}

/// What bond `k` remembers; what the scene leaves out is zero.
inline BondHistory<double> history_of_bond(const BondTable& bonds, std::size_t k) {
  const auto value = [k](const Column<double>& column) { return column.empty() ? 0.0 : column[k]; };
  return {{bonds.shear_x[k], bonds.shear_y[k], bonds.shear_z[k]},
          value(bonds.plastic_stretch),
          value(bonds.damage_normal),
          value(bonds.damage_shear)};
}

/// What became of a bond, as written to results: 0 intact, 1 broken in tension, 2 broken in shear.
enum class BondState : std::uint8_t { intact = 0, broken_tension = 1, broken_shear = 2 };

/// The bond's state from its two damages (both empty spans where the scene has no breakage).
inline BondState bond_state(const BondTable& bonds, std::size_t row) {
  if (bonds.damage_normal.empty()) return BondState::intact;
  if (bonds.damage_normal[row] >= 1.0) return BondState::broken_tension;
  return bonds.damage_shear[row] >= 1.0 ? BondState::broken_shear : BondState::intact;
}

}  // namespace breccia
