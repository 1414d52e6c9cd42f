// The energy of bonds without damage, in registers of every width, held against the sum bond by
// bond.
#include <doctest/doctest.h>

#include "core/world/energies.hpp"
#include "core/world/energy_ledger.hpp"
#include "core/world/loop_views.hpp"
#include "kernels/loops/bond_energy.hpp"
#include "tests/scene.hpp"

using namespace breccia;

namespace {

/// J, as the state's own function has it.
double energy_of_bond(const World& w, std::size_t k, double back) {
  const ParticleTable& p = w.particles;
  const BondTable& b = w.bonds;
  const Row lo = b.row_lo[k], hi = b.row_hi[k];
  const double distance = norm(p.position[hi] - p.position[lo] - back * (p.velocity[hi] - p.velocity[lo]));
  return std::visit(
      [&](const auto& law) {
        return stored_energy(law, constants_of_bond(b, k), history_of_bond(b, k), distance, false);
      },
      w.laws.front());
}

bool is_damaged(const BondTable& b, std::size_t k) {
  return !b.damage_normal.empty() && (b.damage_normal[k] > 0.0 || b.damage_shear[k] > 0.0);
}

}  // namespace

TEST_CASE(
    "undamaged energy: any range of bonds, every register, with and without features [bond by bond, 1e-13]") {
  for (const Features& asked : {Features{}, Features{.plasticity = false, .breakage = false}}) {
    const World w = scene::crushed(asked);
    const BondTable& b = w.bonds;
    std::size_t damaged = 0;
    for (std::size_t k = 0; k < b.size; ++k) damaged += is_damaged(b, k);
    CHECK((damaged > 0) == asked.breakage);
    CHECK(damaged < b.size);
    for (const InstructionSet set :
         {InstructionSet::x86_64, InstructionSet::x86_64_v3, InstructionSet::x86_64_v4}) {
      if (set > best_instruction_set()) continue;
      const UndamagedEnergy energy = undamaged_energy_for(set);
      for (const double back : {0.0, w.dt}) {
        const BondEnergyIn in = bond_energy_in(w, back);
        double all = 0.0;
        for (std::size_t k = 0; k < b.size; ++k) all += energy_of_bond(w, k, back);
        REQUIRE(all > 0.0);
        for (const auto& [first, last] :
             std::initializer_list<std::pair<std::size_t, std::size_t>>{{0, b.size},
                                                                        {0, 1},
                                                                        {0, 3},
                                                                        {1, 2},
                                                                        {5, 6},
                                                                        {3, 20},
                                                                        {9, 9},
                                                                        {17, 80},
                                                                        {b.size - 3, b.size}}) {
          double sum = 0.0;
          for (std::size_t k = first; k < last; ++k)
            if (!is_damaged(b, k)) sum += energy_of_bond(w, k, back);
          INFO(first, " to ", last, " of ", b.size);
          CHECK(std::abs(energy(in, first, last) - sum) <= 1e-13 * all);
        }
        CHECK(std::abs(stored_energy(w, back) - all) <= 1e-3 * all);  // contacts may store some more
        CHECK(stored_energy(w, back) >= all * (1 - 1e-13));
      }
    }
  }
}
