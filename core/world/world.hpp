// Everything that a run moves: tables, boundary, search, constants. Made from an assembly, advanced
// by `step`.
#pragma once
#include <memory>

#include "core/base/timers.hpp"
#include "core/bonding/assembly.hpp"
#include "core/boundary/contact_search.hpp"
#include "core/boundary/end_walls.hpp"
#include "core/boundary/platens_and_confinement.hpp"
#include "core/boundary/tool.hpp"
#include "core/elastic/area_factor.hpp"
#include "core/elastic/dashpots.hpp"
#include "core/elastic/gauges.hpp"
#include "core/elastic/mass_scaling.hpp"
#include "core/elastic/step_monitor.hpp"
#include "core/ranks/partition.hpp"
#include "core/ranks/scatter_plan.hpp"
#include "core/tables/laws.hpp"
#include "core/tables/single_store.hpp"
#include "core/world/crack_record.hpp"
#include "core/world/energy_ledger.hpp"
#include "core/world/options.hpp"
#include "kernels/laws/material.hpp"
#include "kernels/loops/bond_pass.hpp"
#include "kernels/loops/integrate.hpp"
#include "kernels/loops/undamaged_energy.hpp"

namespace breccia {

struct World {
  WorldOptions options;
  Body body;
  Material material;
  Space space = Space::three_d;
  std::vector<BondLaw> laws;  ///< one, or of several materials one for each pair of them
  Features features;          ///< that run: those asked for, or the nearest superset that is built
  double volume = 0;          ///< m^3, nominal
  double alpha = 1;
  std::size_t materials = 1;
  double young = 0;                                    ///< Pa, of the bonds; of several materials the first
  std::vector<double> shear_ratio;                     ///< k_s/k_n, by law
  std::vector<double> contact_young, contact_poisson;  ///< Pa, 1, of contacts, by law
  std::vector<double> friction;                        ///< of broken bonds and contacts, by law
  double critical_dt = 0;                              ///< s, of the bonds; lowered when contacts ask for it
  double dt = 0;                                       ///< s
  double time = 0;                                     ///< s
  std::uint64_t step = 0;
  ParticleTable particles;
  BondTable bonds;
  SingleStore single;  ///< in single precision
  ContactTable contacts;
  std::size_t first_top = 0;
  Partition partition;  ///< of this rank
  /// Of several ranks, on the root: what lists of contacts, pictures and messages are made from.
  std::shared_ptr<World> replica;
  Platens platens;
  Confinement confinement;
  EndWalls end_walls;
  Tool tool;
  NeighbourList neighbour_list;
  ScatterPlan bond_plan, contact_plan;
  CrackRecord cracks;
  EnergyLedger ledger;
  Dashpots dashpots;
  StepMonitor step_monitor;
  Watch watch;  ///< gauges that are read while particles move
  MassScaling mass_scaling;
  BondPass bond_pass = nullptr;
  SinglePass single_pass = nullptr;
  IntegrateSingle integrate_single = nullptr;
  RefreshRecords refresh_records = nullptr;
  CollectSums collect_sums = nullptr;
  SingleEnergy single_energy = nullptr;
  IntegrateFree integrate_free = nullptr;
  UndamagedEnergy undamaged_energy = nullptr;
  Phases phases;
};

}  // namespace breccia
