#include "core/boundary/contact_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/base/error.hpp"
#include "core/base/threads.hpp"
#include "core/bonding/several_materials.hpp"
#include "core/elastic/touching.hpp"
#include "core/geometry/cell_list.hpp"
#include "core/tables/laws.hpp"

namespace breccia {
namespace {

bool are_bonded(const NeighbourList& search, Row a, Row b) {
  return std::binary_search(search.partners.begin() + search.first_partner[a],
                            search.partners.begin() + search.first_partner[a + 1], b);
}

/// Largest distance that a particle has moved against a specimen that is stretched evenly along its
/// axis, and the largest speed: what is uniform brings no two neighbours together by more than
/// strain times their distance.
struct Moved {
  double distance2 = 0, speed2 = 0;
  Moved& operator+=(const Moved& o) {
    distance2 = std::max(distance2, o.distance2);
    speed2 = std::max(speed2, o.speed2);
    return *this;
  }
};

struct EvenStretch {
  double top = 0, square = 0;
  EvenStretch& operator+=(const EvenStretch& o) {
    top += o.top, square += o.square;
    return *this;
  }
};

/// (B126): the step, and with it the dashpot, count with the stiffness of an overlap of a tenth of
/// the smaller radius.
void set_hertz(ContactTable& c, std::size_t k, const ContactMaterial& material, double r, double s) {
  const HertzConstants h =
      hertz_constants(of_law(material.young, c.law, k), of_law(material.poisson, c.law, k), r * s / (r + s));
  c.hertz_normal[k] = h.normal;
  c.hertz_tangential[k] = h.tangential;
  const double root = std::sqrt(0.1 * std::min(r, s)), ratio = of_law(material.shear_ratio, c.law, k);
  c.stiffness[k] = std::max(1.5 * h.normal, ratio > 0.0 ? h.tangential / ratio : 0.0) * root;
}

/// Lists at a fixed distance: what may have met before this one was missed.
void check_interval(NeighbourList& s, double used, std::uint64_t step) {
  const std::uint64_t since = step + static_cast<std::uint64_t>(s.every) - s.next_search;
  if (used > s.slack && since > 0)
    fail<SimulationBroke>(
        "run.search_every = {} is too long for spheres that move as fast as these: {} steps after the last "
        "search they have approached by up to {:.3g} mm, and pairs apart by more than {:.3g} mm were not "
        "listed; "
        "take at most {}, or leave it out",
        s.every, since, 1e3 * used, 1e3 * s.slack,
        std::max<std::uint64_t>(
            1, static_cast<std::uint64_t>(0.5 * static_cast<double>(since) * s.slack / used)));
}

}  // namespace

NeighbourList make_neighbour_list(const Assembly& a, bool enabled, double skin) {
  NeighbourList s;
  s.enabled = enabled;
  s.skin = skin;
  const auto& b = a.bonds;
  std::vector<std::pair<Row, Row>> ends;
  ends.reserve(2 * b.size);
  for (std::size_t k = 0; k < b.size; ++k) {
    ends.emplace_back(b.row_lo[k], b.row_hi[k]);
    ends.emplace_back(b.row_hi[k], b.row_lo[k]);
  }
  std::sort(ends.begin(), ends.end());
  s.first_partner.assign(a.particles.size + 1, 0);
  for (const auto& [row, partner] : ends) {
    ++s.first_partner[row + 1];
    s.partners.push_back(partner);
  }
  for (std::size_t k = 0; k < a.particles.size; ++k) s.first_partner[k + 1] += s.first_partner[k];
  if (!enabled) return s;

  // until the nearest unbonded pair can have met, there is nothing to search for
  const auto& r = a.particles.radius;
  s.position = a.particles.position.copy();
  s.slack = s.skin;
  s.reach = 2.0 * *std::max_element(r.begin(), r.end()) + s.skin;
  for (const auto& [i, j] : near_pairs(s.position, r, 0.0, s.skin, 1))
    if (!are_bonded(s, i, j)) s.slack = std::min(s.slack, norm(s.position[j] - s.position[i]) - r[i] - r[j]);
  return s;
}

bool rebuild_is_due(NeighbourList& s, const ParticleTable& p, const Partition& partition, std::uint64_t step,
                    double dt, int threads) {
  if (!s.enabled || step < s.next_check) return false;
  s.next_check =
      step + static_cast<std::uint64_t>(s.every > 0 ? std::min(s.every, s.check_every) : s.check_every);
  if (s.every > 0 && s.next_search > step) s.next_check = std::min(s.next_check, s.next_search);

  std::vector<EvenStretch> sums;  // along the axis: least squares of u_z over z
  const EvenStretch even = sum_particles(partition, threads, sums, [&](std::size_t row) {
    const double z = s.position[row].z;
    return EvenStretch{z * (p.position[row].z - z), z * z};
  });
  const double stretch = even.square > 0.0 ? even.top / even.square : 0.0;
  std::vector<Moved> blocks;
  const Moved most = sum_particles(partition, threads, blocks, [&](std::size_t row) {
    Vec3 u = p.position[row] - s.position[row];
    u.z -= stretch * s.position[row].z;
    return Moved{dot(u, u), dot(p.velocity[row], p.velocity[row])};
  });
  const double used = 2.0 * std::sqrt(most.distance2) + std::abs(stretch) * s.reach;
  if (s.every > 0) {
    check_interval(s, used, step);
    return step >= s.next_search;
  }
  // what they may still move before the next check counts as used
  const double per_step = 2.0 * 1.5 * dt * std::sqrt(most.speed2), ahead = s.check_every * per_step;
  // slack <= 0: pairs that overlap unbonded are in contact from the start
  const bool due = s.slack <= 0.0 || used + ahead > s.slack;
  // particles so fast that a new list does not last until then are looked at sooner
  if (due && ahead > s.skin)
    s.next_check = step + std::max<std::uint64_t>(1, static_cast<std::uint64_t>(s.skin / per_step));
  return due;
}

void rebuild_neighbour_list(NeighbourList& s, ContactTable& contacts, const ParticleTable& p,
                            const ContactMaterial& material, int threads) {
  const auto& [features, ledger, rolls, hertz] = material.columns;
  const bool first_list = !s.awake;
  s.awake = true;
  s.slack = s.skin;
  ++s.rebuilds;
  s.next_search += static_cast<std::uint64_t>(s.every);
  s.position = p.position.copy();
  std::vector<RowPair> pairs = near_pairs(p.position, p.radius, 0.0, s.skin, threads);
  std::erase_if(pairs, [&](const RowPair& pair) { return are_bonded(s, pair.a, pair.b); });
  std::sort(pairs.begin(), pairs.end(),
            [](const RowPair& x, const RowPair& y) { return std::pair(x.a, x.b) < std::pair(y.a, y.b); });

  const ContactTable before = std::move(contacts);
  std::vector<std::pair<std::pair<Row, Row>, std::size_t>> known;  // pairs with a history worth keeping
  for (std::size_t k = 0; k < before.size; ++k) {
    const double touch = p.radius[before.row_lo[k]] + p.radius[before.row_hi[k]];
    if (before.free_length[k] != touch || !(before.shear_force[k] == Vec3{}) ||
        (ledger && before.viscous_force[k] != 0.0) || (rolls && !(before.couple[k] == Vec3{})))
      known.push_back({std::minmax(before.row_lo[k], before.row_hi[k]), k});
  }
  std::sort(known.begin(), known.end());

  contacts = contact_table(pairs.size(), material.columns);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [lo, hi] = p.gid[pairs[k].a] < p.gid[pairs[k].b] ? std::pair(pairs[k].a, pairs[k].b)
                                                                : std::pair(pairs[k].b, pairs[k].a);
    const double touch = p.radius[lo] + p.radius[hi];
    const double distance = norm(p.position[hi] - p.position[lo]);
    contacts.gid_lo[k] = p.gid[lo];
    contacts.gid_hi[k] = p.gid[hi];
    contacts.row_lo[k] = lo;
    contacts.row_hi[k] = hi;
    if (!contacts.law.empty())
      contacts.law[k] = law_between(p.material[lo], p.material[hi], material.materials);
    // (B30)
    contacts.stiffness[k] = contact_stiffness(of_law(material.young, contacts.law, k), material.alpha,
                                              material.space, p.radius[lo], p.radius[hi]);
    if (hertz) set_hertz(contacts, k, material, p.radius[lo], p.radius[hi]);
    if (features.rotation) contacts.arm_offset[k] = contact_arm_offset(p.radius[lo], p.radius[hi]);
    // pairs that overlap unbonded from the start are free of stress where they are
    contacts.free_length[k] = first_list ? std::min(touch, distance) : touch;  // (B31)
    const std::pair<Row, Row> key = std::minmax(lo, hi);
    const auto found = std::lower_bound(known.begin(), known.end(), std::pair(key, std::size_t{0}));
    if (found != known.end() && found->first == key) {
      contacts.free_length[k] = before.free_length[found->second];
      contacts.shear_force[k] = before.shear_force[found->second];
      if (ledger) contacts.viscous_force[k] = before.viscous_force[found->second];
      if (rolls) contacts.couple[k] = before.couple[found->second];
    }
  }
}

}  // namespace breccia
