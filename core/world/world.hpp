// Everything that a run moves: tables, boundary, search, constants. Made from an assembly, advanced by
// `step`.
#pragma once
#include "core/base/timers.hpp"
#include "core/bonding/assembly.hpp"
#include "core/boundary/contact_search.hpp"
#include "core/boundary/platens_and_confinement.hpp"
#include "core/elastic/area_factor.hpp"
#include "core/elastic/dashpots.hpp"
#include "core/elastic/mass_scaling.hpp"
#include "core/ranks/partition.hpp"
#include "core/ranks/scatter_plan.hpp"
#include "core/tables/mixed_precision.hpp"
#include "core/world/crack_record.hpp"
#include "core/world/energy_ledger.hpp"
#include "core/world/stable_step.hpp"
#include "kernels/laws/material.hpp"
#include "kernels/loops/bond_pass.hpp"
#include "kernels/loops/integrate.hpp"
#include "kernels/loops/undamaged_energy.hpp"

namespace breccia {

struct WorldOptions {
  Features features;  ///< that the scene asks for
  bool new_contacts = true;
  bool rough_platens = true;
  bool rigid_skin = false;  ///< the mantle cannot move sideways
  SkinWeights skin_weights = SkinWeights::radius;
  bool cracks = true;            ///< keep a record of broken bonds
  double contact_damping = 0.9;  ///< xi
  bool paper_form = false;       ///< damping times pi alpha r_c/d0 (P30)
  DampingScheme damping_scheme = DampingScheme::explicit_;
  double damping_step =
      0;  ///< s, at which the scheme is evaluated; 0: the run's own, which converges elsewhere
  GlobalDamping global_damping{0.1, 0.1};
  double safety = 0.8;     ///< of the critical step, at most 1
  double mass_factor = 1;  ///< of the total mass, by which small particles may be made heavier; 1: none
  ScatterKind scatter = ScatterKind::private_sums;
  Precision precision = Precision::full;
  bool ledger = false;  ///< books where the energy goes
  int threads = 1;
  InstructionSet instruction_set = best_instruction_set();
};

struct World {
  WorldOptions options;
  Body body;
  Material material;
  Space space = Space::three_d;
  BondLaw law;
  Features features;  ///< that run: those asked for, or the nearest superset that is built
  double volume = 0;  ///< m^3, nominal
  double alpha = 1;
  double young = 0, shear_ratio = 0;  ///< Pa and k_s/k_n of the bonds
  double friction = 0;                ///< of broken bonds and contacts
  double critical_dt = 0;             ///< s, of the bonds; lowered when contacts ask for it
  double dt = 0;                      ///< s
  double time = 0;                    ///< s
  std::uint64_t step = 0;
  ParticleTable particles;
  BondTable bonds;
  SingleBonds single_bonds;  ///< in mixed precision
  ContactTable contacts;
  std::size_t first_top = 0;
  Partition partition;  ///< of this rank
  Platens platens;
  Confinement confinement;
  NeighbourList neighbour_list;
  ScatterPlan bond_plan, contact_plan;
  CrackRecord cracks;
  EnergyLedger ledger;
  Dashpots dashpots;
  StepMonitor step_monitor;
  MassScaling mass_scaling;
  BondPass bond_pass = nullptr;
  IntegrateFree integrate_free = nullptr;
  WorkOfFree work_of_free = nullptr;
  UndamagedEnergy undamaged_energy = nullptr;
  Phases phases;
};

/// A specimen at rest, ready to be loaded.
World make_world(const Assembly& assembly, const Material& material, const AreaFactor& factor,
                 const WorldOptions& options);

/// What the bond pass reads and what it changes.
BondPassIn bond_pass_in(const World& world);
BondPassHistory bond_pass_history(World& world);

/// What the energy of undamaged bonds reads; places as of `back` seconds ago.
BondEnergyIn bond_energy_in(const World& world, double back);

/// Views of all rows of the particles, for integration.
Motion motion_of(World& world);

/// Brings the table of bonds up to date, before anyone looks at it; in full precision it always is.
void sync(World& world);

/// After the list of contacts was made anew: who adds to whom.
void plan_contacts(World& world);

/// One step: forces at the present positions, then kick and drift.
void advance(World& world);

/// I = factor m r^2
double inertia_factor(const World& world);

struct BrokenCount {
  std::size_t tension = 0, shear = 0;
  BrokenCount& operator+=(const BrokenCount& o) {
    tension += o.tension, shear += o.shear;
    return *this;
  }
};
/// Of all ranks.
BrokenCount count_broken(const World& world);

/// J, of all ranks
double kinetic_energy(const World& world);
/// J, of all ranks, of the particles that an intact bond holds.
double kinetic_energy_of_bonded(const World& world);
/// @param back  s, by which the positions are taken back along the velocities: the world's step gives the
/// moment
///              of the last forces, and of the history
double stored_energy(const World& world, double back = 0.0);

}  // namespace breccia
