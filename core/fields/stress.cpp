#include "core/fields/stress.hpp"

#include <cmath>

#include "core/fields/strain.hpp"
#include "core/fields/tensor_criteria.hpp"
#include "kernels/loops/bond_energy.hpp"

namespace breccia {
namespace {

/// Calls add(lo, hi, unit normal, distance, force on lo) for every bond and every pressed contact
/// of the first so many; padding has no stiffness, and no force.
template <class Add>
void for_each_force(const World& w, std::size_t bonds, std::size_t contacts, const Add& add) {
  const ParticleTable& p = w.particles;
  const BondTable& b = w.bonds;
  const bool coupled = w.features.criterion == Criterion::coupled;
  with_laws(w.laws, b.law, [&](const auto& law_of) {
    for (std::size_t k = 0; k < bonds; ++k) {
      if (b.stiffness[k] == 0.0) continue;
      const Vec3 l = p.position[b.row_hi[k]] - p.position[b.row_lo[k]];
      const double distance = norm(l);
      const Vec3 n = (1.0 / distance) * l;
      const BondForce<double> f =
          force_of_state(law_of(k), constants_of_bond(b, k), history_of_bond(b, k), distance, coupled);
      add(b.row_lo[k], b.row_hi[k], n, distance, f.normal * n + f.shear);
    }
  });
  const ContactTable& c = w.contacts;
  for (std::size_t k = 0; k < contacts; ++k) {
    if (c.stiffness[k] == 0.0) continue;
    const Vec3 l = p.position[c.row_hi[k]] - p.position[c.row_lo[k]];
    const double distance = norm(l), overlap = c.free_length[k] - distance;
    if (overlap <= 0.0) continue;
    const Vec3 n = (1.0 / distance) * l;
    add(c.row_lo[k], c.row_hi[k], n, distance, -pressed_force(c, k, overlap) * n + c.shear_force[k]);
  }
}

void add_product(Stress& s, double factor, const Vec3& f, const Vec3& x) {
  s.normal += factor * Vec3{f.x * x.x, f.y * x.y, f.z * x.z};
  s.shear += (0.5 * factor) * Vec3{f.y * x.z + f.z * x.y, f.z * x.x + f.x * x.z, f.x * x.y + f.y * x.x};
}

}  // namespace

Stress mean_stress_tensor(const World& w) {
  Stress s;
  for_each_force(w, w.bonds.size, w.contacts.size,
                 [&](Row, Row, const Vec3& n, double distance, const Vec3& on_lo) {
                   add_product(s, distance / w.volume, on_lo, n);
                 });
  return s;
}

double held_pressure(const World& w) {
  const Confinement& c = w.confinement;
  const ParticleTable& p = w.particles;
  const auto outward = [&](Row row, const Vec3& f) {
    if (row >= p.free) return 0.0;  // of a rough platen's layer the platen holds some of it
    const Vec3& x = p.position[row];
    if (c.plane) return x.x < 0.0 ? -f.x : f.x;
    if (c.prism) return std::copysign(1.0, x.x) * f.x + std::copysign(1.0, x.y) * f.y;
    const double away = std::hypot(x.x, x.y);
    return away > 0.0 ? (x.x * f.x + x.y * f.y) / away : 0.0;
  };
  std::vector<double> blocks;
  const double pressed = -sum_listed(w.partition, c.rows, 1, blocks,
                                     [&](std::size_t k) { return outward(c.rows[k], c.force[k]); });
  if (!(pressed > 0.0)) return 0.0;
  const auto held_by = [&](Row lo, Row hi, const Vec3& on_lo) {
    return outward(lo, on_lo) - outward(hi, on_lo);
  };
  const bool coupled = w.features.criterion == Criterion::coupled;
  const BondTable& b = w.bonds;
  const auto bonds_hold = [&](const auto& law_of) {
    return sum_pairs(w.partition, b, w.options.threads, blocks, [&](std::size_t k) {
      const Vec3 l = p.position[b.row_hi[k]] - p.position[b.row_lo[k]];
      const double distance = norm(l);
      const BondForce<double> f =
          force_of_state(law_of(k), constants_of_bond(b, k), history_of_bond(b, k), distance, coupled);
      return held_by(b.row_lo[k], b.row_hi[k], (f.normal / distance) * l + f.shear);
    });
  };
  double held = with_laws(w.laws, b.law, bonds_hold);
  const ContactTable& t = w.contacts;
  if (w.neighbour_list.awake)
    held += sum_pairs(w.partition, t, w.options.threads, blocks, [&](std::size_t k) {
      const Vec3 l = p.position[t.row_hi[k]] - p.position[t.row_lo[k]];
      const double distance = norm(l), overlap = t.free_length[k] - distance;
      if (overlap <= 0.0) return 0.0;
      return held_by(t.row_lo[k], t.row_hi[k],
                     (-pressed_force(t, k, overlap) / distance) * l + t.shear_force[k]);
    });
  return c.acting * held / pressed;
}

namespace {

/// Of the mean stress of both ends; for pictures. (B122)
void fill_criteria(World& w) {
  const ParticleTable& p = w.particles;
  BondTable& b = w.bonds;
  for (Column<double>* column : {&b.rankine_state, &b.mohr_coulomb_state, &b.drucker_prager_state})
    column->assign(b.padded, 0.0);
  with_laws(w.laws, b.law, [&](const auto& law_of) {
    for (std::size_t k = 0; k < b.size; ++k) {
      const Row i = b.row_lo[k], j = b.row_hi[k];
      const auto principal = principal_stresses(
          {0.5 * (p.stress_normal[i] + p.stress_normal[j]), 0.5 * (p.stress_shear[i] + p.stress_shear[j])});
      const BondConstants<double> bond = constants_of_bond(b, k);
      const auto limits = limits_of(law_of(k), bond);
      const TensorStrengths strengths{limits.tension / bond.strength_area,
                                      limits.cohesion / bond.strength_area,
                                      law_of(k).failure.friction_pressed};
      b.rankine_state[k] = rankine_state(principal, strengths);
      b.mohr_coulomb_state[k] = mohr_coulomb_state(principal, strengths);
      b.drucker_prager_state[k] = drucker_prager_state(principal, strengths);
    }
  });
}

void fill_bond_columns(World& w) {
  const ParticleTable& p = w.particles;
  BondTable& b = w.bonds;
  for (Column<double>* column : {&b.normal_force, &b.normal_stress, &b.shear_stress})
    column->assign(b.padded, 0.0);
  const bool breaks = !b.damage_normal.empty();
  if (breaks) b.failure_state.assign(b.padded, 0.0);
  const bool coupled = w.features.criterion == Criterion::coupled;
  with_laws(w.laws, b.law, [&](const auto& law_of) {
    for (std::size_t k = 0; k < b.size; ++k) {
      const double distance = norm(p.position[b.row_hi[k]] - p.position[b.row_lo[k]]);
      const BondConstants<double> bond = constants_of_bond(b, k);
      const BondHistory<double> h = history_of_bond(b, k);
      const BondForce<double> f = force_of_state(law_of(k), bond, h, distance, coupled);
      b.normal_force[k] = f.normal;
      b.normal_stress[k] = f.normal / bond.area;
      b.shear_stress[k] = norm(f.shear) / bond.area;
      if (breaks) b.failure_state[k] = failure_state(law_of(k), bond, h, distance, coupled);
    }
  });
}

}  // namespace

void fill_stress_columns(World& w) {
  ParticleTable& p = w.particles;
  const auto share = [&](std::size_t row) {
    const double r = p.radius[row];
    return w.space == Space::two_d ? r * r : r * r * r;
  };
  double shares = 0.0;
  for (std::size_t row = 0; row < p.size; ++row) shares += share(row);
  std::vector<Stress> stress(p.size);
  // of several ranks the copies too: they end in this one's part
  for_each_force(w, w.bonds.padded, w.contacts.padded,
                 [&](Row lo, Row hi, const Vec3& n, double distance, const Vec3& on_lo) {
                   const double ratio = distance / (p.radius[lo] + p.radius[hi]);
                   add_product(stress[lo], ratio * p.radius[lo], on_lo, n);
                   add_product(stress[hi], ratio * p.radius[hi], on_lo, n);
                 });
  if (!w.partition.ranks.alone()) {  // a bond's other end may be another rank's
    const Rows mine = w.partition.owned();
    stress = gather_elements_everywhere(
        w.partition.ranks, std::span<const Stress>(stress).subspan(mine.first, mine.last - mine.first));
  }
  p.stress_normal.assign(p.padded, {});
  p.stress_shear.assign(p.padded, {});
  for (std::size_t row = 0; row < p.size; ++row) {
    const double by_volume = shares / (share(row) * w.volume);
    p.stress_normal[row] = by_volume * stress[row].normal;
    p.stress_shear[row] = by_volume * stress[row].shear;
  }
  const std::vector<Strain> strain = strains(w);
  p.strain_normal.assign(p.padded, {});
  p.strain_shear.assign(p.padded, {});
  for (std::size_t row = 0; row < p.size; ++row) {
    p.strain_normal[row] = strain[row].normal;
    p.strain_shear[row] = strain[row].shear;
  }
  fill_bond_columns(w);
  if (w.features.breakage) fill_criteria(w);
}

}  // namespace breccia
