#include "core/tables/single_store.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/threads.hpp"
#include "kernels/laws/bond_law.hpp"

namespace breccia {
namespace {

double power_of_two_above(double a) { return std::exp2(std::ceil(std::log2(a))); }

/// Modulo 2^32.
std::int32_t wrapped(double whole) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(static_cast<std::int64_t>(whole)));
}

Vec3 rounded(const Vec3& v, double unit) {
  return {unit * std::nearbyint(v.x / unit), unit * std::nearbyint(v.y / unit),
          unit * std::nearbyint(v.z / unit)};
}

void put(std::int32_t (&row)[4], const Vec3& v, double unit) {
  row[0] = wrapped(std::nearbyint(v.x / unit));
  row[1] = wrapped(std::nearbyint(v.y / unit));
  row[2] = wrapped(std::nearbyint(v.z / unit));
}

double coarse_unit(const Quanta& q) { return q.length * coarse_parts; }

void put_spin(MotionRecord& r, const ParticleTable& p, std::size_t row, const Quanta& q, double dt) {
  if (!p.spin.empty()) put(r.spun, (p.radius[row] * dt) * p.spin[row], q.motion);
}

/// The record's fourth numbers: the place in quanta of motion.
void put_fine_place(MotionRecord& r, const Vec3& place, const Quanta& q) {
  const auto coarse = static_cast<std::uint32_t>(coarse_unit(q) / q.motion);
  const auto fine = [&](double of_anchor, std::int32_t anchor) {
    return static_cast<std::int32_t>(
        static_cast<std::uint32_t>(wrapped(std::nearbyint(of_anchor / q.motion))) +
        coarse * static_cast<std::uint32_t>(anchor));
  };
  r.place[3] = fine(place.x, r.anchor[0]);
  r.moved[3] = fine(place.y, r.anchor[1]);
  r.spun[3] = fine(place.z, r.anchor[2]);
}

/// Bonds by row of their ends: shear is on the nearer one.
double sign_of(const BondTable& b, std::size_t k) { return b.row_lo[k] > b.row_hi[k] ? -1.0 : 1.0; }

/// What is broken and has its ends so far apart that a record could not tell: it rests.
bool rests(const ParticleTable& p, const BondTable& b, std::size_t k, const Quanta& q, bool broken) {
  const double reach = 0x1p29 * coarse_unit(q);
  const Vec3 branch = p.position[b.row_hi[k]] - p.position[b.row_lo[k]];
  return broken && dot(branch, branch) > reach * reach;
}

float narrow(double a) { return static_cast<float>(a); }

void put_stiffness(BondBlock& block, std::size_t j, const BondTable& b, std::size_t k, const Quanta& q,
                   double dt, bool resting) {
  block.stiffness[j] = resting ? 0.0f : narrow(b.stiffness[k] * (q.length / q.force));
  const double damping = b.damping.empty() || b.stiffness[k] == 0.0 ? 0.0 : b.damping[k];
  block.damping[j] = resting ? 0.0f : narrow(damping * (q.length / (dt * q.force)));
}

/// m, by which a bond would be longer than at rest with both ends at their anchors.
double anchored_stretch(const ParticleTable& p, const BondTable& b, std::size_t k) {
  return norm(p.anchor[b.row_hi[k]] - p.anchor[b.row_lo[k]]) - b.rest_length[k];
}

/// @param anchored  m
void put_anchored(BondBlock& block, RareBlock& rare, std::size_t j, double anchored, const Quanta& q) {
  rare.anchored[j] = narrow(anchored / q.length);
  block.plastic[j] = rare.plastic_stretch[j] - rare.anchored[j];
}

void scale(std::span<float> values, float by) {
  for (float& v : values) v *= by;
}

std::vector<BondLaw> laws_in_units(std::span<const BondLaw> laws, const Quanta& q) {
  std::vector<BondLaw> scaled;
  for (const BondLaw& law : laws)
    scaled.push_back(std::visit([&](const auto& l) { return BondLaw(in_units(l, q.length, q.force)); }, law));
  return scaled;
}

void list_bonds_of(SingleStore& s, const BondTable& b) {
  const auto visit = [&](const auto& visit_end) {
    for (std::size_t k = 0; k < b.padded; ++k)
      if (b.stiffness[k] > 0.0)
        for (const Row row : {b.row_lo[k], b.row_hi[k]}) visit_end(row, static_cast<Index>(k));
  };
  s.first_bond.assign(s.motion.size() + 1, 0);
  visit([&](Row row, Index) { ++s.first_bond[row + 1]; });
  for (std::size_t row = 0; row < s.motion.size(); ++row) s.first_bond[row + 1] += s.first_bond[row];
  s.bonds_of.resize(s.first_bond.back());
  std::vector<Index> next(s.first_bond.begin(), s.first_bond.end() - 1);
  visit([&](Row row, Index k) { s.bonds_of[next[row]++] = k; });
}

void fill_motion(SingleStore& s, const ParticleTable& p) {
  const Quanta& q = s.quanta;
  s.motion.assign(p.size, {});
  s.sums.assign(p.size, {});
  s.moved_far.clear();
  for (std::size_t row = 0; row < p.size; ++row) {
    MotionRecord& r = s.motion[row];
    const Vec3 place = p.position[row] - q.origin - p.anchor[row];
    put(r.place, place, q.length);
    put(r.moved, p.last_move[row], q.motion);
    put(r.anchor, p.anchor[row], coarse_unit(q));
    put_spin(r, p, row, q, s.dt);
    put_fine_place(r, place, q);
    if (is_far(s, row)) s.moved_far.push_back(static_cast<Row>(row));
  }
}

/// What never changes of a bond.
/// @param at  its place in the store; k: its row, for padding that of another
void put_constants(SingleStore& s, std::size_t at, std::size_t k, const ParticleTable& p,
                   const BondTable& b) {
  const std::size_t j = at % bond_block;
  BondBlock& block = s.bonds[at / bond_block];
  const auto [near, far] = std::minmax(b.row_lo[k], b.row_hi[k]);
  block.near[j] = row_unit * near, block.far[j] = row_unit * far;
  block.per_radii[j] = narrow(s.quanta.length / (p.radius[near] + p.radius[far]));
  block.area[j] = narrow(b.area[k] / s.quanta.force);
  s.rare[at / bond_block].strength_area[j] = narrow(strength_areas(b)[k] / s.quanta.force);
}

void put_history(SingleStore& s, std::size_t k, const ParticleTable& p, const BondTable& b) {
  const Quanta& q = s.quanta;
  const std::size_t j = k % bond_block;
  BondBlock& block = s.bonds[k / bond_block];
  RareBlock& rare = s.rare[k / bond_block];
  const BondHistory<double> h = history_of_bond(b, k);
  rare.plastic_stretch[j] = narrow(h.plastic_stretch / q.length);
  put_anchored(block, rare, j, anchored_stretch(p, b, k), q);
  const bool broken = h.damage_normal >= 1.0 || h.damage_shear >= 1.0;
  put_stiffness(block, j, b, k, q, s.dt, rests(p, b, k, q, broken));
  const double shear = sign_of(b, k) / q.force;
  block.shear_x[j] = narrow(shear * h.shear.x);
  block.shear_y[j] = narrow(shear * h.shear.y);
  block.shear_z[j] = narrow(shear * h.shear.z);
  rare.damage_normal[j] = narrow(h.damage_normal);
  rare.damage_shear[j] = narrow(h.damage_shear);
  if (h.damage_normal > 0.0 || h.damage_shear > 0.0) s.damaged[k / bond_block] = 1;
  if (s.ledger.empty()) return;
  LedgerBlock& ledger = s.ledger[k / bond_block];
  ledger.viscous_force[j] = narrow(b.viscous_force[k] / q.force);
  ledger.spring_force[j] = narrow(b.spring_force[k] / q.force);
  ledger.shear_factor[j] = narrow(b.shear_factor[k]);
}

/// m
double length_quantum(const BondTable& b) {
  double sum = 0, longest = 0;
  for (std::size_t k = 0; k < b.size; ++k) {
    sum += b.rest_length[k];
    longest = std::max(longest, b.rest_length[k]);
  }
  const double mean = sum / static_cast<double>(std::max<std::size_t>(1, b.size));
  return power_of_two_above(std::max({mean / 32.0, longest / 128.0, 1e-30})) * 0x1p-31;
}

}  // namespace

double shortest_told(const BondTable& b) { return 0x1p22 * length_quantum(b); }

Quanta choose_quanta(const ParticleTable& p, const BondTable& b, double dt) {
  Quanta q;
  double strongest = 0, arm = 1, fastest = 0;
  std::vector<unsigned> bonds_of(p.size);
  for (std::size_t k = 0; k < b.size; ++k) {
    strongest = std::max(strongest, b.stiffness[k] * b.rest_length[k]);
    arm = std::max(arm, b.rest_length[k] / (p.radius[b.row_lo[k]] + p.radius[b.row_hi[k]]));
    ++bonds_of[b.row_lo[k]], ++bonds_of[b.row_hi[k]];
  }
  q.length = length_quantum(b);
  for (std::size_t row = 0; row < p.size; ++row)
    fastest =
        std::max({fastest, norm(p.velocity[row]), p.spin.empty() ? 0.0 : p.radius[row] * norm(p.spin[row])});
  for (q.motion = q.length / 4.0; fastest * dt > fast_motion * q.motion;) q.motion *= 4.0;
  const unsigned most = b.size == 0 ? 1 : *std::max_element(bonds_of.begin(), bonds_of.end());
  // of each bond of the particle that has most; moments, over the radius, are as much larger as
  // bonds are longer than both radii
  q.force_limit = 0x1p31 / (1.25 * arm * most);
  constexpr double strain = 0.0005;  // to begin with: the finer, the less noise where forces are small
  q.force = power_of_two_above(std::max(strongest * strain / q.force_limit, 1e-30));
  Vec3 low, high;
  for (std::size_t row = 0; row < p.size; ++row) {
    const Vec3& x = p.position[row];
    if (row == 0) low = high = x;
    low = {std::min(low.x, x.x), std::min(low.y, x.y), std::min(low.z, x.z)};
    high = {std::max(high.x, x.x), std::max(high.y, x.y), std::max(high.z, x.z)};
  }
  q.origin = rounded(0.5 * (low + high), coarse_unit(q));
  return q;
}

std::size_t store_bytes(const SingleStore& s) {
  const auto bytes = [](const auto&... columns) {
    return ((columns.size() * sizeof(typename std::decay_t<decltype(columns)>::value_type)) + ...);
  };
  return bytes(s.motion, s.sums, s.bonds, s.rare, s.ledger, s.damaged, s.near, s.far, s.first_bond,
               s.bonds_of);
}

void set_anchors(const Quanta& q, ParticleTable& p, double dt) {
  p.anchor.assign(p.padded, {});
  p.last_move.assign(p.padded, {});
  for (std::size_t row = 0; row < p.size; ++row) {
    p.anchor[row] = rounded(p.position[row] - q.origin, coarse_unit(q));
    p.last_move[row] = rounded(dt * p.velocity[row], q.motion);
  }
}

void history_to_table(const SingleStore& s, std::size_t first, std::size_t last, BondTable& b, int threads) {
  if (s.empty()) return;
  const Quanta& q = s.quanta;
  for_rows(last - first, threads, [&](std::size_t from, std::size_t to) {
    for (std::size_t k = first + from; k < first + to;) {
      const std::size_t place = k % bond_block, count = std::min(bond_block - place, first + to - k);
      const BondBlock& block = s.bonds[k / bond_block];
      const RareBlock& rare = s.rare[k / bond_block];
      double force[bond_block];  // of either sign
      for (std::size_t j = 0; j < count; ++j) force[j] = sign_of(b, k + j) * q.force;
      const auto widen = [&](const float* values, Column<double>& column) {
        for (std::size_t j = 0; j < count; ++j) column[k + j] = static_cast<double>(values[place + j]);
      };
      const auto widen_shear = [&](const float* values, Column<double>& column) {
        for (std::size_t j = 0; j < count; ++j)
          column[k + j] = force[j] * static_cast<double>(values[place + j]);
      };
      widen_shear(block.shear_x, b.shear_x);
      widen_shear(block.shear_y, b.shear_y);
      widen_shear(block.shear_z, b.shear_z);
      if (!b.plastic_stretch.empty())
        for (std::size_t j = 0; j < count; ++j)
          b.plastic_stretch[k + j] = q.length * static_cast<double>(rare.plastic_stretch[place + j]);
      if (s.damaged[k / bond_block] != 0) {
        widen(rare.damage_normal, b.damage_normal);
        widen(rare.damage_shear, b.damage_shear);
      }
      if (!s.ledger.empty()) {
        const LedgerBlock& ledger = s.ledger[k / bond_block];
        widen(ledger.viscous_force, b.viscous_force);
        widen(ledger.spring_force, b.spring_force);
        widen(ledger.shear_factor, b.shear_factor);
        for (std::size_t j = k; j < k + count; ++j)
          b.viscous_force[j] *= q.force, b.spring_force[j] *= q.force;
      }
      k += count;
    }
  });
}

void moves_to_table(const SingleStore& s, ParticleTable& p) {
  const double unit = s.quanta.motion;
  for (std::size_t row = 0; row < s.motion.size(); ++row) {
    const auto& moved = s.motion[row].moved;
    p.last_move[row] = {unit * moved[0], unit * moved[1], unit * moved[2]};
  }
}

bool is_far(const SingleStore& s, std::size_t row) {
  const auto& place = s.motion[row].place;
  return std::any_of(place, place + 3, [](std::int32_t x) { return (x ^ (x >> 31)) >= far_place; });
}

void renew_anchors(SingleStore& s, ParticleTable& p, const BondTable& b) {
  const Quanta& q = s.quanta;
  std::vector<Index> touched;
  for (const Row row : s.moved_far) {
    MotionRecord& r = s.motion[row];
    const Vec3 from_origin = p.position[row] - q.origin;
    p.anchor[row] = rounded(from_origin, coarse_unit(q));
    put(r.anchor, p.anchor[row], coarse_unit(q));
    put(r.place, from_origin - p.anchor[row], q.length);
    touched.insert(touched.end(), s.bonds_of.begin() + s.first_bond[row],
                   s.bonds_of.begin() + s.first_bond[row + 1]);
  }
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  for (const std::size_t k : touched) {
    const std::size_t j = k % bond_block;
    BondBlock& block = s.bonds[k / bond_block];
    RareBlock& rare = s.rare[k / bond_block];
    put_anchored(block, rare, j, anchored_stretch(p, b, k), q);
    const bool broken = rare.damage_normal[j] >= 1.0f || rare.damage_shear[j] >= 1.0f;
    const bool resting = rests(p, b, k, q, broken);
    if (broken && resting != (block.stiffness[j] == 0.0f)) put_stiffness(block, j, b, k, q, s.dt, resting);
  }
  s.renewals += s.moved_far.size();
  s.moved_far.clear();
}

void coarsen_force(SingleStore& s, std::span<const BondLaw> laws) {
  constexpr float by = 0.25f;
  s.quanta.force /= static_cast<double>(by);
  for (BondBlock& block : s.bonds)
    for (auto* column :
         {&block.stiffness, &block.area, &block.damping, &block.shear_x, &block.shear_y, &block.shear_z})
      scale(*column, by);
  for (RareBlock& block : s.rare) scale(block.strength_area, by);
  for (LedgerBlock& block : s.ledger) scale(block.viscous_force, by), scale(block.spring_force, by);
  s.laws = laws_in_units(laws, s.quanta);
  ++s.coarsenings;
}

void coarsen_motion(SingleStore& s, const ParticleTable& p) {
  Quanta& q = s.quanta;
  const double before = q.motion;
  q.motion *= 4.0;
  for (std::size_t row = 0; row < s.motion.size(); ++row) {
    MotionRecord& r = s.motion[row];
    put(r.moved, before * Vec3{1.0 * r.moved[0], 1.0 * r.moved[1], 1.0 * r.moved[2]}, q.motion);
    put_spin(r, p, row, q, s.dt);
    put_fine_place(r, p.position[row] - q.origin - p.anchor[row], q);
  }
  ++s.coarsenings;
}

void add_apart(SingleStore& s, ParticleTable& p, std::size_t first, std::size_t last) {
  if (s.apart.empty()) return;
  struct Sum {
    std::int64_t force[3] = {}, moment[3] = {};
  };
  std::map<Row, Sum> sums;
  for (const LoadApart& load : s.apart)
    for (const auto& [row, sign] : {std::pair{load.near, 1.0}, std::pair{load.far, -1.0}}) {
      if (row < first || row >= last) continue;
      Sum& sum = sums[row];
      for (int k = 0; k < 3; ++k) {
        sum.force[k] += std::llrint(sign * load.force[k]);
        sum.moment[k] += std::llrint(load.moment[k]);
      }
    }
  const auto in_si = [&](const std::int64_t(&sum)[3]) {
    return s.quanta.force *
           Vec3{static_cast<double>(sum[0]), static_cast<double>(sum[1]), static_cast<double>(sum[2])};
  };
  for (const auto& [row, sum] : sums) {
    p.force[row] += in_si(sum.force);
    if (!p.torque.empty()) p.torque[row] += p.radius[row] * in_si(sum.moment);
  }
  s.apart.clear();
}

void fit_step(SingleStore& s, const ParticleTable& p, const BondTable& b, double dt) {
  if (s.empty()) return;
  s.dt = dt;
  for (std::size_t k = 0; k < b.padded; ++k) {
    BondBlock& block = s.bonds[k / bond_block];
    const bool resting = block.stiffness[k % bond_block] == 0.0f;
    put_stiffness(block, k % bond_block, b, k, s.quanta, dt, resting);
  }
  for (std::size_t row = 0; row < p.size; ++row) put_spin(s.motion[row], p, row, s.quanta, dt);
}

void fill(SingleStore& s, const ParticleTable& p, const BondTable& b, std::span<const BondLaw> laws,
          double dt) {
  s.dt = dt;
  s.laws = laws_in_units(laws, s.quanta);
  s.own_strength_area = !b.strength_area.empty();
  fill_motion(s, p);
  list_bonds_of(s, b);
  const std::size_t blocks =
      (b.padded + ForceBuffer::capacity - 1) / ForceBuffer::capacity * (ForceBuffer::capacity / bond_block);
  s.bonds.assign(blocks, {});
  s.rare.assign(blocks, {});
  s.damaged.assign(blocks, 0);
  s.ledger.assign(b.viscous_force.empty() ? 0 : blocks, {});
  for (std::size_t k = 0; k < blocks * bond_block && b.padded > 0; ++k) {
    put_constants(s, k, std::min(k, b.padded - 1), p, b);
    if (k < b.padded) put_history(s, k, p, b);
  }
}

void set_targets(SingleStore& s, std::span<const Index> to_lo, std::span<const Index> to_hi,
                 std::size_t slots, const BondTable& b) {
  s.near.clear(), s.far.clear();
  if (s.empty() || to_lo.empty()) return;
  s.sums.resize(s.motion.size() + slots);
  const auto in_units_of_rows = [](Index row) { return row_unit * (row & ~shared_row) | (row & shared_row); };
  for (std::size_t at = 0; at < s.bonds.size() * bond_block; ++at) {
    const std::size_t k = std::min(at, b.padded - 1);
    const bool swapped = sign_of(b, k) < 0.0;
    s.near.push_back(in_units_of_rows(swapped ? to_hi[k] : to_lo[k]));
    s.far.push_back(in_units_of_rows(swapped ? to_lo[k] : to_hi[k]));
  }
}

}  // namespace breccia
