// Contacts between surfaces that were never bonded. The search sleeps until two of them can meet,
// then is renewed whenever particles have used up the skin.
#pragma once
#include <vector>

#include "core/bonding/assembly.hpp"
#include "core/ranks/partition.hpp"
#include "core/ranks/scatter_plan.hpp"
#include "core/tables/contact_table.hpp"

namespace breccia {

struct NeighbourList {
  bool enabled = true;  ///< off: the scene leaves out new contacts
  bool awake = false;   ///< a list of candidates exists
  double skin = 0;      ///< m, candidates are apart by less than this
  double slack = 0;     ///< m, what pairs may approach before the list must be renewed
  double reach = 0;     ///< m, largest distance that a candidate pair can have
  // (B97)
  int check_every = 16;           ///< steps
  int every = 0;                  ///< steps from list to list; 0: when the skin is used up
  std::uint64_t next_check = 0;   ///< step
  std::uint64_t next_search = 0;  ///< step, where lists are made every so many
  std::uint64_t rebuilds = 0;
  Column<Vec3> position;             ///< m, of the particles when the list was made
  std::vector<Index> first_partner;  ///< per particle: rows bonded to it, rising
  std::vector<Row> partners;
};

/// @param skin  m
NeighbourList make_neighbour_list(const Assembly& assembly, bool enabled, double skin);

/// True when surfaces without a bond may have come within reach since the list was made. Every rank
/// comes to the same answer.
/// @throws SimulationBroke where lists are made every so many steps, and spheres have met between
/// two
bool rebuild_is_due(NeighbourList& search, const ParticleTable& particles, const Partition& partition,
                    std::uint64_t step, double dt, int threads);

/// See the column arm_offset.
inline double contact_arm_offset(double radius_lo, double radius_hi) {
  return 0.5 * (radius_lo - radius_hi) / (radius_lo + radius_hi);
}

/// What a new contact is made of.
struct ContactMaterial {
  std::span<const double> young, poisson;  ///< Pa, 1: one, or by law
  std::span<const double> shear_ratio;     ///< k_s/k_n: one, or by law
  std::size_t materials = 1;
  double alpha = 0;  ///< area factor, as of the bonds
  Space space = Space::three_d;
  ContactColumns columns{};
};

/// Makes the list of candidates anew, their dashpots not yet set; pairs that were in contact keep
/// their history.
void rebuild_neighbour_list(NeighbourList& search, ContactTable& contacts, const ParticleTable& particles,
                            const ContactMaterial& material, int threads);

}  // namespace breccia
