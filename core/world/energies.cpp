#include "core/world/energies.hpp"

#include <cmath>

#include "core/world/cement.hpp"
#include "core/world/loop_views.hpp"
#include "kernels/loops/bond_energy.hpp"
#include "kernels/loops/rolling_pass.hpp"

namespace breccia {

BrokenCount count_broken(const World& w) {
  std::vector<BrokenCount> blocks;
  return sum_pair_ranges(w.partition, w.bonds, w.options.threads, blocks,
                         [&](std::size_t first, std::size_t last) {
                           BrokenCount count;
                           for_damaged(w, first, last, [&](std::size_t k) {
                             const BondState state = bond_state(w.bonds, k);
                             count += {std::size_t{state == BondState::broken_tension},
                                       std::size_t{state == BondState::broken_shear}};
                           });
                           return count;
                         });
}

namespace {

/// J, of one particle.
double kinetic_energy_of(const ParticleTable& p, std::size_t row, double factor) {
  double twice = p.mass[row] * dot(p.velocity[row], p.velocity[row]);
  if (!p.spin.empty()) twice += inertia(factor, p.mass[row], p.radius[row]) * dot(p.spin[row], p.spin[row]);
  return 0.5 * twice;
}

}  // namespace

double kinetic_energy(const World& w) {
  std::vector<double> blocks;
  const double factor = inertia_factor(w);
  return sum_particles(w.partition, w.options.threads, blocks,
                       [&](std::size_t row) { return kinetic_energy_of(w.particles, row, factor); });
}

namespace {

/// Per row, whether an intact bond holds it.
std::vector<char> rows_in_bonds(const World& w) {
  std::vector<char> is_held(w.particles.position.size(), 0);
  for (std::size_t k = 0; k < w.bonds.padded; ++k)
    if (w.bonds.stiffness[k] > 0.0 && bond_state(w.bonds, k) == BondState::intact)
      is_held[w.bonds.row_lo[k]] = is_held[w.bonds.row_hi[k]] = 1;
  return is_held;
}

}  // namespace

std::vector<Gid> loose_at_surface(const World& w) {
  const std::vector<char> is_held = rows_in_bonds(w);
  std::vector<Gid> mine;
  for_owned_entries(w.partition, w.confinement.rows, [&](std::size_t k) {
    const Row row = w.confinement.rows[k];
    if (!is_held[row]) mine.push_back(w.particles.gid[row]);
  });
  if (w.partition.ranks.alone()) return mine;
  return gather_elements_everywhere(w.partition.ranks, std::span<const Gid>(mine));
}

double kinetic_energy_of_bonded(const World& w) {
  const std::vector<char> is_held = rows_in_bonds(w);
  std::vector<double> blocks;
  const double factor = inertia_factor(w);
  return sum_particles(w.partition, w.options.threads, blocks, [&](std::size_t row) {
    return is_held[row] ? kinetic_energy_of(w.particles, row, factor) : 0.0;
  });
}

namespace {

/// J, in the moments of cement, and in the springs against rolling of a table of pairs. (B116)
template <class Table>
double rolling_energy(const World& w, const Table& t) {
  // every rank takes part in the sum, one without rows too
  const bool cement = std::holds_alternative<ParallelBondLaw>(w.laws.front());
  if (!cement && (!(w.material.rolling_friction > 0.0) || !(w.shear_ratio.front() > 0.0))) return 0.0;
  std::vector<double> blocks;
  return sum_pairs(w.partition, t, w.options.threads, blocks, [&](std::size_t k) {
    if (t.couple.empty()) return 0.0;
    const double size2 = dot(t.couple[k], t.couple[k]);
    if (!(size2 > 0.0)) return 0.0;
    if constexpr (std::is_same_v<Table, BondTable>)
      if (cement && bond_state(t, k) == BondState::intact) return moment_energy(w, k);
    const auto& r = w.particles.radius;
    return 0.5 * size2 /
           rolling_stiffness(w.shear_ratio.front() * t.stiffness[k], r[t.row_lo[k]], r[t.row_hi[k]]);
  });
}

}  // namespace

double stored_energy(const World& w, double back) {
  std::vector<double> blocks;
  const ParticleTable& p = w.particles;
  const auto distance_of = [&](Row lo, Row hi) {
    return norm(p.position[hi] - p.position[lo] - back * (p.velocity[hi] - p.velocity[lo]));
  };
  const BondTable& b = w.bonds;
  const bool coupled = w.features.criterion == Criterion::coupled;
  const BondEnergyIn in = bond_energy_in(w, back);
  const SingleEnergyIn in_single = single_energy_in(w, back);
  const double sum =
      rolling_energy(w, w.bonds) + with_laws(w.laws, b.law, [&](const auto& law_of) {
        return sum_pair_ranges(
            w.partition, b, w.options.threads, blocks, [&](std::size_t first, std::size_t last) {
              // the quick way knows k_n and one k_s/k_n alone
              const bool each = w.laws.size() > 1 || unloads_elsewhere(law_of(0));
              double energy = each               ? 0.0
                              : w.single.empty() ? w.undamaged_energy(in, first, last)
                                                 : w.single_energy(in_single, first, last);
              if (b.damage_normal.empty() && !each) return energy;
              const auto add = [&](std::size_t k) {
                energy += stored_energy(law_of(k), constants_of_bond(b, k), history_of_bond(b, k),
                                        distance_of(b.row_lo[k], b.row_hi[k]), coupled);
              };
              if (each) {
                for (std::size_t k = first; k < last; ++k) add(k);
                return energy;
              }
              for_damaged(w, first, last, [&](std::size_t k) {
                if (b.damage_normal[k] > 0.0 || b.damage_shear[k] > 0.0) add(k);
              });
              return energy;
            });
      });
  const ContactTable& c = w.contacts;
  if (!w.neighbour_list.awake) return sum;
  return sum + rolling_energy(w, c) +
         sum_pairs(w.partition, c, w.options.threads, blocks, [&](std::size_t k) {
           const double overlap = c.free_length[k] - distance_of(c.row_lo[k], c.row_hi[k]);
           if (overlap <= 0.0) return 0.0;
           const SurfaceSpring spring =
               surface_spring(constants_of_contact(c, k, of_law(w.shear_ratio, c.law, k)), overlap);
           double energy = spring.stored;
           if (spring.across > 0.0) energy += 0.5 * dot(c.shear_force[k], c.shear_force[k]) / spring.across;
           return energy;
         });
}

}  // namespace breccia
