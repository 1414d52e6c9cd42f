// Pairs of particles that were never bonded and lie within the skin of the search: candidates, most
// of them apart.
#pragma once
#include <vector>

#include "core/tables/column.hpp"
#include "core/tables/table.hpp"
#include "kernels/laws/bond_laws.hpp"
#include "kernels/laws/surface_contact.hpp"

namespace breccia {

// clang-format off
#define BRECCIA_CONTACT_COLUMNS(COLUMN)                                                                               \
  COLUMN(Gid,    gid_lo,      "1",     identity,  always,          "smaller global id of the two ends")               \
  COLUMN(Gid,    gid_hi,      "1",     identity,  always,          "larger global id of the two ends")                \
  COLUMN(Row,    row_lo,      "1",     scratch,   always,          "row of the end gid_lo")                           \
  COLUMN(Row,    row_hi,      "1",     scratch,   always,          "row of the end gid_hi")                           \
  COLUMN(LawIndex, law,       "1",     reference, several,         "as of a bond")                                    \
  COLUMN(double, free_length, "m",     history,   always,          "distance below which the pair presses: the initial one of a pair that overlapped unbonded, until it parts, then r_lo + r_hi") \
  COLUMN(double, arm_offset,  "1",     scratch,   rotation,        "(r_lo - r_hi)/(r_lo + r_hi)/2, as of a bond")     \
  COLUMN(double, stiffness,   "N/m",   reference, always,          "k_n = E A/(r_lo + r_hi)")                         \
  COLUMN(double, damping,     "N s/m", reference, contact_damping, "c_n as of a bond")                                \
  COLUMN(double, hertz_normal, "N/m^1.5", reference, hertz,        "F = this times the overlap to 3/2; then stiffness is that of an overlap of r/10") \
  COLUMN(double, hertz_tangential, "N/m^1.5", reference, hertz,    "k_t = this times the root of the overlap") \
  COLUMN(Vec3,   shear_force, "N",     history,   always,          "friction force on lo")                            \
  COLUMN(Vec3,   couple,      "N m",   history,   rolling,         "resistance to rolling on lo")                     \
  COLUMN(double, viscous_force, "N",   ledger,    ledger,          "of the dashpot along the pair, as it was applied, tension positive")
// clang-format on

struct ContactTable {
  BRECCIA_TABLE(BRECCIA_CONTACT_COLUMNS)
};

/// What contacts of a scene have beside what all have.
struct ContactColumns {
  Features features;
  bool ledger = false, rolls = false, hertz = false;
};

/// A table of so many rows, all zero.
inline ContactTable contact_table(std::size_t rows, const ContactColumns& columns) {
  ContactTable c;
  c.resize(rows, columns.features);
  if (columns.ledger) c.viscous_force.assign(c.padded, 0.0);
  if (columns.rolls) c.couple.assign(c.padded, {});
  if (columns.hertz) c.hertz_normal.assign(c.padded, 0.0), c.hertz_tangential.assign(c.padded, 0.0);
  return c;
}

/// Row `k` without its dashpot.
inline ContactConstants constants_of_contact(const ContactTable& c, std::size_t k, double shear_ratio) {
  ContactConstants one{c.stiffness[k], shear_ratio};
  if (!c.hertz_normal.empty())
    one.hertz_normal = c.hertz_normal[k], one.hertz_tangential = c.hertz_tangential[k];
  return one;
}

/// N, with which row `k` presses at an overlap, m, of 0 or more.
inline double pressed_force(const ContactTable& c, std::size_t k, double overlap) {
  return surface_spring(constants_of_contact(c, k, 0.0), overlap).force;
}

}  // namespace breccia
