// Pairs of particles that were never bonded and lie within the skin of the search: candidates, most
// of them apart.
#pragma once
#include <vector>

#include "core/tables/column.hpp"
#include "core/tables/table.hpp"

namespace breccia {

// clang-format off
#define BRECCIA_CONTACT_COLUMNS(COLUMN)                                                                               \
  COLUMN(Gid,    gid_lo,      "1",     identity,  always,          "smaller global id of the two ends")               \
  COLUMN(Gid,    gid_hi,      "1",     identity,  always,          "larger global id of the two ends")                \
  COLUMN(Row,    row_lo,      "1",     scratch,   always,          "row of the end gid_lo")                           \
  COLUMN(Row,    row_hi,      "1",     scratch,   always,          "row of the end gid_hi")                           \
  COLUMN(double, free_length, "m",     history,   always,          "distance below which the pair presses: the initial one of a pair that overlapped unbonded, until it parts, then r_lo + r_hi") \
  COLUMN(double, arm_offset,  "1",     scratch,   rotation,        "(r_lo - r_hi)/(r_lo + r_hi)/2, as of a bond")     \
  COLUMN(double, stiffness,   "N/m",   reference, always,          "k_n = E A/(r_lo + r_hi)")                         \
  COLUMN(double, damping,     "N s/m", reference, contact_damping, "c_n as of a bond")                                \
  COLUMN(Vec3,   shear_force, "N",     history,   always,          "friction force on lo")                            \
  COLUMN(Vec3,   couple,      "N m",   history,   rolling,         "resistance to rolling on lo")                     \
  COLUMN(double, viscous_force, "N",   ledger,    ledger,          "of the dashpot along the pair, as it was applied, tension positive")
// clang-format on

struct ContactTable {
  BRECCIA_TABLE(BRECCIA_CONTACT_COLUMNS)
};

}  // namespace breccia
