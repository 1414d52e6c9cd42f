// The loop over bonds in single precision: what it reads and writes. Places never enter it: motion
// is kept as integers, exactly, and only differences of bonded neighbours are turned into floats;
// forces are added as integers, whose sum does not depend on the order. docs/model.md, "Single
// precision".
//
// Units in the loop: a quantum of length, one of motion, one of force, the step. All quanta are
// powers of two in SI, so that turning a number costs it nothing.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/loops/bond_pass.hpp"
#include "kernels/loops/integrate.hpp"
#include "kernels/single/pair_motion.hpp"

namespace breccia {

/// What the loop sees of a particle: one line of the cache. All modulo 2^32, since only differences
/// of neighbours count. The fourth of a row is none of the loop's: there lies the place itself, in
/// quanta of motion, from which the next step's displacement is counted.
struct alignas(64) MotionRecord {
  std::int32_t place[4] = {};   ///< displacement from the anchor, quanta of length
  std::int32_t moved[4] = {};   ///< displacement of the last step, quanta of motion
  std::int32_t spun[4] = {};    ///< radius times spin times step, quanta of motion
  std::int32_t anchor[4] = {};  ///< place that displacements count from, 512 quanta
};

/// Sums over the bonds of a particle: force, and moment over the radius; in quanta of force.
struct alignas(32) IntegerSums {
  std::int32_t force[4] = {}, moment[4] = {};
};

inline constexpr std::size_t bond_block = 16;  ///< bonds that lie side by side

/// Rows are kept so that an address follows without arithmetic: records lie 8 times, sums 4 times
/// this number of bytes from the first.
inline constexpr Index row_unit = 8;

/// What every bond needs in every step. Ends by row, the lower first: shear is on that one.
struct alignas(64) BondBlock {
  Index near[bond_block], far[bond_block];  ///< rows of the ends, times row_unit
  float per_radii[bond_block];              ///< 1/(r_lo + r_hi)
  float stiffness[bond_block];              ///< k_n
  float area[bond_block];                   ///< m^2 per quantum of force, so that stresses stay in Pa
  float damping[bond_block];                ///< c_n over the step
  float shear_x[bond_block], shear_y[bond_block], shear_z[bond_block];
  float plastic[bond_block];  ///< plastic stretch less `anchored`: what the stretch is counted from
};

/// What a bond needs that is damaged or yields.
struct alignas(64) RareBlock {
  float anchored[bond_block];  ///< stretch with both ends at their anchors
  float plastic_stretch[bond_block];
  float damage_normal[bond_block], damage_shear[bond_block];
  float strength_area[bond_block];  ///< as area
};

/// What the ledger keeps.
struct alignas(64) LedgerBlock {
  float viscous_force[bond_block], spring_force[bond_block], shear_factor[bond_block];
};

/// What happened that somebody must see to: bits.
enum SingleEvent : unsigned {
  force_is_large = 1,   ///< a bond's force is more than sums hold: it was kept apart
  force_is_lost = 2,    ///< it is no number
  place_is_far = 4,     ///< a particle has moved far from its anchor
  motion_is_fast = 8,   ///< a particle comes near to a motion that records can tell
  motion_is_lost = 16,  ///< or beyond it
};

/// What a bond adds to its ends, where that is more than sums hold.
struct LoadApart {
  Index near, far;             ///< rows of the ends
  double force[3], moment[3];  ///< as in the sums; the force on the far end is the opposite
};

/// Where bonds add their loads, by bond row: rows of sums times row_unit, of the nearer end first;
/// empty: at the rows of the ends.
struct SingleTargets {
  std::span<const Index> near, far;
  bool atomic = false;  ///< a row with the top bit set is one that other ranges touch too
};

/// Displacement from its anchor, in quanta, from which on a particle gets another one; places from
/// the origin, in quanta, that records cannot tell; motion in one step, in its quanta, for which
/// they should become coarser, and that records cannot tell.
inline constexpr std::int32_t far_place = 1 << 29;
inline constexpr double lost_place = 0x1p48, fast_motion = 0x1p28, lost_motion = 0x1p30;

struct SinglePassIn {
  std::span<const BondLaw> laws;  ///< in the loop's units
  std::span<const LawIndex> law;  ///< of several materials: which of the laws
  std::span<BondBlock> bonds;
  std::span<RareBlock> rare;
  std::span<LedgerBlock> ledger;         ///< empty: none
  std::span<std::uint8_t> damaged;       ///< by block: whether any bond of it is
  std::span<BondLosses<double>> losses;  ///< J, by 64 bonds
  std::span<const MotionRecord> motion;
  std::span<IntegerSums> sums;
  SingleTargets targets;
  std::span<const Index> row_lo, row_hi;    ///< of the table: which end the shear of its rows is on
  double length = 1, moved = 1, force = 1;  ///< m, m, N, quanta of length, motion and force
  float force_limit = 0;                    ///< quanta, of a component: more than this is kept apart
  bool own_strength_area = false;
};

/// Bonds [first, last), both multiples of 64. Breaks are noted unless the pointer is null.
/// @param apart  takes loads that are more than sums hold
/// @returns SingleEvent bits
using SinglePass = unsigned (*)(const SinglePassIn&, std::size_t first, std::size_t last, BreakNotes*,
                                std::vector<LoadApart>& apart);

/// The kernel of a law for features that are built (see built_features).
/// @throws std::invalid_argument
SinglePass single_pass_for(const BondLaw& law, const Features& built, InstructionSet set);

struct SingleEnergyIn {
  std::span<const BondBlock> bonds;
  std::span<const RareBlock> rare;
  std::span<const MotionRecord> motion;
  double length = 1, moved = 1, force = 1;  ///< m, m, N, quanta of length, motion and force
  double shear_ratio = 0;                   ///< k_s/k_n of all bonds
  bool before_last_move = false;            ///< with places as they were before the last step
};

/// J, stored by the undamaged ones of bonds [first, last).
using SingleEnergy = double (*)(const SingleEnergyIn&, std::size_t first, std::size_t last);
SingleEnergy single_energy_for(InstructionSet set);

/// Places in doubles and records of them.
struct RecordedMotion {
  Strided<const Vec3> position, velocity, spin;  ///< spin is empty where nothing spins
  std::span<const double> radius;
  std::span<MotionRecord> records;
  Vec3 origin;
  double length = 1, moved = 1;  ///< m, quanta of length and motion
};

/// Records of rows [first, last) after a step.
/// @returns SingleEvent bits
using RefreshRecords = unsigned (*)(const RecordedMotion&, std::size_t first, std::size_t last, double dt);
RefreshRecords refresh_records_for(InstructionSet set);

struct CollectedSums {
  std::span<IntegerSums> sums;  ///< read, then zeroed
  Strided<Vec3> force, torque;  ///< N, N m, added to; torque is empty where nothing spins
  std::span<const double> radius;
  double force_quantum = 1;  ///< N
};

/// Kick and drift of rows [first, last) that move freely, under their forces and the bonds' sums,
/// and records of where they are then: one way through all of it.
using IntegrateSingle = Integrated (*)(const Motion&, const RecordedMotion&, const CollectedSums&,
                                       std::size_t first, std::size_t last, double dt, const GlobalDamping&,
                                       bool booked);
IntegrateSingle integrate_single_for(InstructionSet set);

/// Adds the sums of rows [first, last) to the particles' forces.
using CollectSums = void (*)(const CollectedSums&, std::size_t first, std::size_t last);
CollectSums collect_sums_for(InstructionSet set);

}  // namespace breccia
