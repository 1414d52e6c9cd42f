#include "core/checks/stability_checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>

#include "core/base/error.hpp"
#include "core/checks/diagnosis.hpp"
#include "core/world/energies.hpp"

namespace breccia {
namespace {

/// What goes on along a bond or contact, as the end of a message names it.
struct Link {
  Gid lo, hi;
  double turn;  ///< motion of its ends against each other in a step, over its length
};

double turn_of(const ParticleTable& p, Row lo, Row hi, double dt) {
  const double step = dt * norm(p.velocity[hi] - p.velocity[lo]);
  return step / norm(p.position[hi] - p.position[lo]);
}

/// Of all bonds that hold a particle the one whose ends move most against each other.
std::optional<Link> busiest_bond(const World& w, Row row) {
  std::optional<Link> found;
  const BondTable& b = w.bonds;
  for (std::size_t k = 0; k < b.size; ++k) {
    if ((b.row_lo[k] != row && b.row_hi[k] != row) || bond_state(b, k) != BondState::intact) continue;
    const double turn = turn_of(w.particles, b.row_lo[k], b.row_hi[k], w.dt);
    if (!found || turn > found->turn || std::isnan(turn)) found = Link{b.gid_lo[k], b.gid_hi[k], turn};
  }
  return found;
}

[[noreturn]] void stop(const World& w, const std::string& what, Row row, const std::string& to_do) {
  const auto bond = busiest_bond(w, row);
  const std::string at =
      bond ? fmt::format("its bond {}-{} moves most", bond->lo, bond->hi) : std::string("no bond holds it");
  fail<SimulationBroke>("at {:.6g} s (step {}) {}; {}; {}", w.time, w.step, what, at, to_do);
}
[[noreturn]] void stop(const World& w, const std::string& what, Row row) {
  stop(w, what, row, advice(w, row));
}

bool is_finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void check_numbers(const World& w, double kinetic, double stored) {
  if (std::isfinite(kinetic) && std::isfinite(stored)) return;
  const ParticleTable& p = w.particles;
  const Rows own = w.partition.owned();
  for (std::size_t k = own.first; k < own.last; ++k) {
    const bool spin = p.spin.empty() || is_finite(p.spin[k]);
    const char* lost = !is_finite(p.velocity[k])   ? "velocity"
                       : !is_finite(p.position[k]) ? "position"
                       : !spin                     ? "spin"
                                                   : nullptr;
    if (lost) stop(w, fmt::format("particle {} has a {} that is not a number", p.gid[k], lost), Row(k));
  }
  for (std::size_t k = 0; k < w.bonds.size; ++k) {
    const BondHistory<double> h = history_of_bond(w.bonds, k);
    if (is_finite(h.shear) && std::isfinite(h.plastic_stretch)) continue;
    stop(w, fmt::format("bond {}-{} has a force that is not a number", w.bonds.gid_lo[k], w.bonds.gid_hi[k]),
         w.bonds.row_lo[k]);
  }
  stop(w, "the energy is not a number", 0);
}

/// The particle of this rank with the most kinetic energy of translation.
Row most_energetic(const World& w) {
  const ParticleTable& p = w.particles;
  const auto energy = [&](std::size_t k) { return p.mass[k] * dot(p.velocity[k], p.velocity[k]); };
  const Rows own = w.partition.owned();
  std::size_t most = std::min(own.first, p.size - 1);
  for (std::size_t k = own.first; k < own.last; ++k)
    if (energy(k) > energy(most)) most = k;
  return static_cast<Row>(most);
}

/// J, of the layers in the motion that the platens prescribe: not the specimen's own.
double energy_of_layers(const Platens& platens) {
  double twice = 0.0;
  for (const std::size_t k : {0u, 1u}) {
    const Vec3& v = platens.velocity[k];
    twice += platens.mass[k] * (platens.rough ? dot(v, v) : v.z * v.z);
  }
  return 0.5 * twice;
}

/// J, that platens and a tool have done; of the tool's some is friction on its own face.
double driven_work(const World& w) { return w.platens.work + w.tool.work; }

/// J, of what is driven and of pressure since the last look. The pressure on a particle hardly
/// changes from one look to the next, whatever the particle does meanwhile.
double work_since(StabilityChecks& g, const World& w) {
  const double work = driven_work(w) - g.platen_work;
  g.platen_work = driven_work(w);
  const Confinement& c = w.confinement;
  std::vector<double> blocks;
  return work + sum_listed(w.partition, c.rows, 1, blocks, [&](std::size_t k) {
           const Vec3& x = w.particles.position[c.rows[k]];
           const double by_pressure = 0.5 * dot(g.push[k] + c.force[k], x - g.lateral[k]);
           g.lateral[k] = x;
           g.push[k] = c.force[k];
           return by_pressure;
         });
}

void check_energy(StabilityChecks& g, const World& w, double kinetic, double stored) {
  g.accounted = std::max(0.0, g.accounted + work_since(g, w));
  const double own = std::max(0.0, kinetic - energy_of_layers(w.platens));
  const double bound = allowed_excess(w) * (g.accounted + 0.01 * g.max_energy) + g.noise;  // (B58)
  double there = own + stored;
  // with the places of the step whose forces the bonds remember: where places have gone on since, a
  // bond that yields seems to hold more than it does
  if (there > bound) there = own + stored_energy(w, w.dt);
  if (there > bound) {
    const Row row = most_energetic(w);
    stop(
        w,
        fmt::format("energy comes from nowhere: {:.3g} J kinetic and stored, where {:.3g} J are explained by "
                    "what was there and the work since; particle {} has most of it, {:.3g} m/s",
                    there, g.accounted, w.particles.gid[row], norm(w.particles.velocity[row])),
        row, advice_far_away(g.farthest, g.size).value_or(advice(w, row)));
  }
  g.accounted = std::min(g.accounted, there);
  g.max_energy = std::max(g.max_energy, there);
}

/// @returns m/s, the largest speed
double check_speeds(const StabilityChecks& g, const World& w) {
  const ParticleTable& p = w.particles;
  const Rows own = w.partition.owned();
  double most2 = 0.0;
  for (std::size_t k = own.first; k < own.last; ++k) {
    const double speed2 = dot(p.velocity[k], p.velocity[k]);
    most2 = std::max(most2, speed2);
    if (speed2 > g.fastest * g.fastest)
      stop(w,
           fmt::format("particle {} moves at {:.3g} m/s, faster than a wave in the stiffest bond, {:.3g} m/s",
                       p.gid[k], std::sqrt(speed2), g.fastest),
           Row(k));
  }
  return std::sqrt(most2);
}

/// The books of the ledger: what they cannot place, and losses that give energy back.
void check_balance(const World& w) {
  constexpr std::uint64_t first_steps = 500;  // work and losses are next to nothing before
  if (!w.ledger.enabled || w.step < first_steps || energy_error(w.ledger) < out_of_balance) return;
  const Row row = most_energetic(w);
  stop(w,
       fmt::format("energy is out of balance: {:.1f} % of the work put in is missing, or came back from what "
                   "was lost",
                   100.0 * energy_error(w.ledger)),
       row, advice(w, row));
}

/// A bond's shear force is carried along by the turn of its normal from step to step, which a turn
/// beyond a right angle leaves without a meaning.
void check_turns(const World& w) {
  const ParticleTable& p = w.particles;
  const BondTable& b = w.bonds;
  // of several ranks the copies too: the end that is fast may be this one's alone
  for (std::size_t k = 0; k < b.padded; ++k) {
    if (b.stiffness[k] == 0.0) continue;  // padding
    const Row lo = b.row_lo[k], hi = b.row_hi[k];
    const Vec3 l = p.position[hi] - p.position[lo];
    if (dot(l, l - w.dt * (p.velocity[hi] - p.velocity[lo])) > 0.0) continue;
    const double reach = 0.2 * (p.radius[lo] + p.radius[hi]);
    const std::string cause =
        b.rest_length[k] < reach
            ? fmt::format(
                  "likely cause: the spheres are nested, their centres {:.3g} m apart; take one away, or "
                  "try time.safety = {:.2g}",
                  b.rest_length[k], 0.1 * w.options.safety)
            : advice(w, lo);
    fail<SimulationBroke>(
        "at {:.6g} s (step {}) bond {}-{}, {:.3g} m long, has turned through more than a right angle in one "
        "step, particle {} at {:.3g} m/s; {}",
        w.time, w.step, b.gid_lo[k], b.gid_hi[k], norm(l), b.gid_lo[k], norm(p.velocity[lo]), cause);
  }
}

void check_places(const StabilityChecks& g, const World& w) {
  const ParticleTable& p = w.particles;
  const Rows own = w.partition.owned();
  const double most = lost_sizes * g.size;
  for (std::size_t k = own.first; k < own.last; ++k) {
    const Vec3 away = p.position[k] - g.centre;
    if (dot(away, away) <= most * most) continue;
    stop(w,
         fmt::format("particle {} is lost: {:.3g} m from the middle of a specimen of {:.3g} m, at {:.3g} m/s",
                     p.gid[k], norm(away), g.size, norm(p.velocity[k])),
         Row(k), advice_for_lost(w, Row(k)));
  }
}

}  // namespace

double allowed_excess(const World& w) {
  if (w.dt > w.critical_dt) return 2.0;  // nothing there wavers about what it is
  const double s = 0.98 * w.dt / w.critical_dt;
  return 1.5 * (1.0 + s) / (1.0 - s);
}

StabilityChecks make_stability_checks(const World& w) {
  StabilityChecks g;
  const ParticleTable& p = w.particles;
  Vec3 low = p.position[0], high = low;
  for (std::size_t k = 0; k < p.size; ++k) {
    const Vec3& x = p.position[k];
    const double r = p.radius[k];
    low = {std::min(low.x, x.x - r), std::min(low.y, x.y - r), std::min(low.z, x.z - r)};
    high = {std::max(high.x, x.x + r), std::max(high.y, x.y + r), std::max(high.z, x.z + r)};
    g.farthest = std::max({g.farthest, std::abs(x.x), std::abs(x.y), std::abs(x.z)});
  }
  g.centre = 0.5 * (low + high);
  g.size = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  const BondTable& b = w.bonds;
  double extremes[] = {b.size > 0 ? fastest_wave(w) : 0.0, -std::numeric_limits<double>::infinity()};
  for (std::size_t k = 0; k < b.size; ++k) extremes[1] = std::max(extremes[1], -b.rest_length[k]);
  all_reduce_max(w.partition.ranks, extremes);
  g.fastest = extremes[0] > 0.0 ? extremes[0] : std::numeric_limits<double>::infinity();
  g.shortest = -extremes[1];
  g.accounted = g.max_energy =
      std::max(0.0, kinetic_energy(w) - energy_of_layers(w.platens)) + stored_energy(w);
  // each place is rounded at every step; errors of 64 steps in a row, all one way
  const double rounding = 64.0 * std::numeric_limits<double>::epsilon() * g.farthest;
  std::vector<double> blocks;
  g.noise = sum_pairs(w.partition, b, w.options.threads, blocks,
                      [&](std::size_t k) { return 0.5 * b.stiffness[k] * rounding * rounding; });
  g.platen_work = driven_work(w);
  for (const Row row : w.confinement.rows) g.lateral.push_back(w.particles.position[row]);
  g.push = w.confinement.force;
  return g;
}

void gather_surface_marks(StabilityChecks& g, const World& w) {
  const Ranks& ranks = w.partition.ranks;
  if (ranks.alone()) return;
  for (std::vector<Vec3>* noted : {&g.lateral, &g.push}) {
    std::vector<Vec3> all = gather_owned_entries<Vec3>(w.partition, w.confinement.rows, *noted);
    if (ranks.is_root()) *noted = std::move(all);
  }
}

namespace {

void check_here(StabilityChecks& g, const World& w, double kinetic, double stored) {
  check_numbers(w, kinetic, stored);
  check_energy(g, w, kinetic, stored);
  check_balance(w);
  // no bond can have turned so far whose ends did not move by a good part of its length
  const double speed = check_speeds(g, w);
  if (2.0 * speed * w.dt > 0.05 * g.shortest) check_turns(w);
  check_places(g, w);
}

/// The complaint of the lowest rank that has one, on every rank.
std::string complaint_of_all(const Ranks& ranks, const std::string& mine) {
  if (!any(ranks, !mine.empty())) return {};
  const std::vector<std::size_t> sizes = sizes_of_all(ranks, mine.size());
  const std::vector<char> all = gather_elements_everywhere(ranks, std::span(mine.data(), mine.size()));
  const std::size_t first = *std::ranges::find_if(sizes, [](std::size_t size) { return size > 0; });
  return {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(first)};
}

}  // namespace

void check(StabilityChecks& g, const World& w, double kinetic, double stored) {
  if (w.partition.ranks.alone()) return check_here(g, w, kinetic, stored);
  std::string complaint;
  try {
    check_here(g, w, kinetic, stored);
  } catch (const SimulationBroke& broke) {
    complaint = broke.what();
  }
  complaint = complaint_of_all(w.partition.ranks, complaint);
  if (!complaint.empty()) throw SimulationBroke(complaint);
}

}  // namespace breccia
