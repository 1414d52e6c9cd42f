// The particles of a scene as a structure of arrays, two of them of records. Rows [0, free) move
// freely; rows [free, size) belong to a platen. Within each part rows lie along a space-filling
// curve.
#pragma once
#include <vector>

#include "core/tables/column.hpp"
#include "core/tables/particle_records.hpp"
#include "core/tables/table.hpp"
#include "kernels/laws/bond_laws.hpp"

namespace breccia {

// clang-format off
#define BRECCIA_PARTICLE_COLUMNS(COLUMN)                                                                              \
  COLUMN(Gid,    gid,                "1",      identity,  always,   "global id, as in the specimen's file")           \
  COLUMN(LawIndex, material,         "1",      reference, several,  "0: of [material], n: of the n-th [[material.group]]") \
  COLUMN(double, radius,             "m",      reference, always,   "radius of the sphere")                           \
  COLUMN(double, mass,               "kg",     reference, always,   "density times volume, and more where masses are scaled")  \
  COLUMN(Vec3,   reference_position, "m",      reference, always,   "centre when the bonds were made")                \
  COLUMN(Vec3,   orientation,        "rad",    state,     orientation, "rotation since the start: along the axis, as long as the angle") \
  COLUMN(Vec3,   anchor,             "m",      state,     single,   "in single precision, place that displacements count from, less the origin of all") \
  COLUMN(Vec3,   last_move,          "m",      state,     single,   "in single precision, displacement of the last step, as the bonds saw it") \
  COLUMN(Vec3,   stress_normal,      "Pa",     derived,   stress,   "xx, yy, zz of the mean stress in the particle's share of the volume, tension positive") \
  COLUMN(Vec3,   stress_shear,       "Pa",     derived,   stress,   "yz, zx, xy of the same")                          \
  COLUMN(Vec3,   strain_normal,      "1",      derived,   stress,   "xx, yy, zz of the strain of the particle's neighbourhood, elongation positive") \
  COLUMN(Vec3,   strain_shear,       "1",      derived,   stress,   "yz, zx, xy of the same, half the change of the angle")

/// Those that lie in the records of ParticleRecords.
#define BRECCIA_PARTICLE_FIELDS(COLUMN)                                                                               \
  COLUMN(Vec3,   position,           "m",      state,     always,   "centre")                                         \
  COLUMN(Vec3,   velocity,           "m/s",    state,     always,   "of the centre, half a step before position")     \
  COLUMN(Vec3,   spin,               "1/s",    state,     rotation, "angular velocity, half a step before position")  \
  COLUMN(Vec3,   force,              "N",      scratch,   always,   "sum of the contact and boundary forces")         \
  COLUMN(Vec3,   torque,             "N m",    scratch,   rotation, "sum of the contact torques")
// clang-format on

struct ParticleColumns {
  BRECCIA_TABLE(BRECCIA_PARTICLE_COLUMNS)
};

struct ParticleTable : ParticleColumns, ParticleRecords {
  std::size_t free = 0;  ///< rows [0, free) move freely, the others are held by a platen

  template <class Visit>
  void for_each_column(Visit&& visit) {
    ParticleColumns::for_each_column(visit);
    BRECCIA_PARTICLE_FIELDS(BRECCIA_COLUMN_VISIT)
  }
  template <class Visit>
  void for_each_column(Visit&& visit) const {
    ParticleColumns::for_each_column(visit);
    BRECCIA_PARTICLE_FIELDS(BRECCIA_COLUMN_VISIT)
  }
  void resize(std::size_t rows, const Features& features) {
    ParticleColumns::resize(rows, features);
    resize_records(rows, features.rotation);
  }
};

}  // namespace breccia
