// Single precision: what the loop over bonds reads and writes in place of the tables, which stay
// what everything else reads. Particles move in doubles; their records are made anew after each
// step, and the integer sums are turned into their forces. The bonds' history lives here and is
// copied into the table where it is looked at (sync in core/world/sync.hpp). docs/model.md, "Single
// precision".
#pragma once
#include "core/tables/bond_table.hpp"
#include "core/tables/particle_table.hpp"
#include "kernels/single/single.hpp"

namespace breccia {

/// Units of the loop, and what its integers hold.
struct Quanta {
  double length = 0;       ///< m, a power of two
  double motion = 0;       ///< m, of one step, a power of two; coarser when something is fast
  double force = 0;        ///< N, a power of two; coarser when forces ask for it
  double force_limit = 0;  ///< of a component of a bond's force, in quanta: what sums hold of every bond
  Vec3 origin;             ///< m, that anchors count from
};

/// The shortest bond of which a quantum of length is no more than a float's last bit. A specimen
/// that has shorter ones, spheres nested in each other, runs in double.
/// @returns m
double shortest_told(const BondTable& bonds);

/// Chosen from a whole specimen, the same on every rank.
Quanta choose_quanta(const ParticleTable& particles, const BondTable& bonds, double dt);

/// Empty where the scene runs in double precision.
struct SingleStore {
  Quanta quanta;
  double dt = 0;                   ///< s, that dashpots and spins are kept for
  unsigned events = 0;             ///< SingleEvent bits that nobody has seen to yet
  std::uint64_t renewals = 0;      ///< of anchors, particle by particle
  std::uint64_t coarsenings = 0;   ///< of the quantum of force or motion, by four
  bool ghosts_are_current = true;  ///< records of particles that other ranks move
  Column<MotionRecord> motion;
  Column<IntegerSums> sums;
  Column<BondBlock> bonds;
  Column<RareBlock> rare;
  Column<LedgerBlock> ledger;
  Column<std::uint8_t> damaged;        ///< by block: whether a bond of it is
  Column<Index> near, far;             ///< where loads go, of several threads
  Column<Index> first_bond, bonds_of;  ///< of each particle
  std::vector<Row> moved_far;          ///< particles that want another anchor before the next pass
  std::vector<LoadApart> apart;        ///< of this step: more than sums hold
  std::vector<BondLaw> laws;           ///< in the loop's units
  bool own_strength_area = false;

  bool empty() const { return bonds.empty(); }
};

/// Of all its columns.
std::size_t store_bytes(const SingleStore& store);

/// Particles get the columns that single precision needs: anchors where they are, no last move.
void set_anchors(const Quanta& quanta, ParticleTable& particles, double dt);

/// From tables that are up to date; quanta and counts stay.
/// @param laws    of the scene, SI
void fill(SingleStore& store, const ParticleTable& particles, const BondTable& bonds,
          std::span<const BondLaw> laws, double dt);

/// Rows that the bonds' loads go to, of several threads.
/// @param to_lo, to_hi  rows of sums, as of a scatter plan; empty: those of the ends
/// @param slots         rows beyond those of the particles
void set_targets(SingleStore& store, std::span<const Index> to_lo, std::span<const Index> to_hi,
                 std::size_t slots, const BondTable& bonds);

/// Takes the dashpots, and the ends' spins, for another step.
void fit_step(SingleStore& store, const ParticleTable& particles, const BondTable& bonds, double dt);

/// Copies the history of bonds [first, last) into the table.
void history_to_table(const SingleStore& store, std::size_t first, std::size_t last, BondTable& bonds,
                      int threads = 1);

/// Copies the last step's displacements into the table of particles.
void moves_to_table(const SingleStore& store, ParticleTable& particles);

/// Whether a particle has moved far from its anchor.
bool is_far(const SingleStore& store, std::size_t row);

/// Displacements of those that have moved far count from where they are now: no place changes, and
/// stretches by no more than a float's last bit. Broken bonds whose ends are far apart rest until
/// they come near again. Which particles these are follows from the particles alone, so that ranks
/// need not tell each other.
void renew_anchors(SingleStore& store, ParticleTable& particles, const BondTable& bonds);

/// Four times the quantum of force.
void coarsen_force(SingleStore& store, std::span<const BondLaw> laws);

/// Four times the quantum of motion.
void coarsen_motion(SingleStore& store, const ParticleTable& particles);

/// Adds what was kept apart to the particles' forces: whole quanta, so that the order is all one.
/// @param first, last  rows that this rank moves
void add_apart(SingleStore& store, ParticleTable& particles, std::size_t first, std::size_t last);

}  // namespace breccia
