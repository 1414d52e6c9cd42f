#include "core/world/stable_step.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/elastic/step_block.hpp"
#include "core/world/loop_views.hpp"
#include "core/world/sync.hpp"
#include "core/world/world.hpp"

namespace breccia {
namespace {

StepScene step_scene(const World& w) {
  const GlobalDamping& global = w.options.global_damping;
  return {.particles = w.particles,
          .bonds = w.bonds,
          .contacts = w.contacts,
          .dashpots = w.dashpots,
          .shear_ratio = w.shear_ratio,
          .global_damping = global.viscous ? 0.0 : std::max(global.translation, global.rotation),
          .reach = w.neighbour_list.skin,
          .freedom = {w.options.features.rotation, w.space == Space::two_d, inertia_factor(w),
                      std::holds_alternative<ParallelBondLaw>(w.laws.front())},
          .threads = w.options.threads};
}

void set_bond_dashpots(World& w) {
  BondTable& b = w.bonds;
  if (b.damping.empty()) return;
  for (std::size_t k = 0; k < b.padded; ++k) b.damping[k] = bond_dashpot(w.dashpots, w.particles, b, k, w.dt);
  fit_step(w.single, w.particles, b, w.dt);
}

void set_contact_dashpots(World& w) {
  ContactTable& c = w.contacts;
  if (c.damping.empty()) return;
  for (std::size_t k = 0; k < c.padded; ++k)
    c.damping[k] = contact_dashpot(w.dashpots, w.particles, c, k, w.dt);
}

using Pairs = std::vector<std::pair<Gid, Gid>>;

Pairs pairs_of(const ContactTable& c) {
  Pairs pairs;
  for (std::size_t k = 0; k < c.size; ++k) pairs.emplace_back(c.gid_lo[k], c.gid_hi[k]);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Rows of contacts that the last look did not count.
std::vector<std::size_t> uncounted(const ContactTable& c, const Pairs& counted) {
  std::vector<std::size_t> rows;
  for (std::size_t k = 0; k < c.size; ++k)
    if (!std::binary_search(counted.begin(), counted.end(), std::pair(c.gid_lo[k], c.gid_hi[k])))
      rows.push_back(k);
  return rows;
}

[[noreturn]] void refuse_step(const World& w) {
  const auto& r = w.particles.radius;
  const auto smallest =
      std::min_element(r.begin(), r.begin() + static_cast<std::ptrdiff_t>(w.particles.size));
  fail<BadInput>(
      "time: no step can be found, the critical one is {} s; check the material, and sphere {} of radius "
      "{:.3g} m",
      w.critical_dt, w.particles.gid[static_cast<std::size_t>(smallest - r.begin())], *smallest);
}

/// What an estimate may be, which comes from below.
constexpr double largest_number = 0.98;

/// (B130): whether new contacts leave the step as it is, by a look at what is near them: the modes
/// that they may add are a few spheres wide, and elsewhere the network has only lost stiffness.
/// From time to time the whole is looked at all the same.
bool stands_near(const StepScene& scene, std::span<const std::size_t> added, double dt,
                 StepMonitor& monitor) {
  constexpr int width = 3;  // bonds
  constexpr std::uint64_t whole_every = 20;
  // the first says what margin the whole has
  if (monitor.looks == 0 || (monitor.looks + monitor.local_looks) % whole_every == 0) return false;
  const StepBlock block = block_around(scene, added, width);
  const double number = estimate_step(block.scene(scene), dt, largest_number).number;
  if (number > largest_number) return false;
  monitor.margin = std::min(monitor.margin, 1.0 - number / largest_number);
  ++monitor.local_looks;
  return true;
}

}  // namespace

void set_dashpots(World& w) {
  set_bond_dashpots(w);
  set_contact_dashpots(w);
}

void choose_step(World& w) {
  const WorldOptions& o = w.options;
  if (!(o.safety > 0.0 && o.safety <= 1.0))
    fail<BadInput>("time.safety must be above 0 to 1, not {}: beyond the critical step a run blows up",
                   o.safety);
  if (o.mass_factor > 1.0)
    w.mass_scaling = scale_masses(w.particles, own_time_steps(step_scene(w)), o.mass_factor);
  w.dashpots.scheme = o.damping_scheme;
  w.dashpots.xi = w.features.contact_damping ? o.contact_damping : 0.0;
  w.dashpots.paper_alpha = o.paper_form ? w.alpha : 0.0;
  w.dashpots.held_step = o.damping_step;
  sum_loads(w.dashpots, w.particles, w.bonds);
  w.critical_dt = critical_time_step(step_scene(w));
  if (!(std::isfinite(w.critical_dt) && w.critical_dt > 0.0)) refuse_step(w);
  // (B116): a spring against rolling adds a quarter at most to what shear gives a particle
  if (w.material.rolling_friction > 0.0) w.critical_dt /= std::sqrt(1.25);
  if (w.features.plasticity) {  // (B118): a bond that has yielded may be stiffer
    double most = 1.0;
    for (const BondLaw& law : w.laws)
      most = std::max(most, std::visit([](const auto& l) { return stiffest(l); }, law));
    w.critical_dt /= std::sqrt(most);
  }
  if (o.global_damping.viscous) {
    // (B113): (w dt/2)^2 = 1 - c dt/2 instead of 1
    const double a = 0.25 * w.critical_dt * w.critical_dt * o.global_damping.translation;
    w.critical_dt = std::sqrt(a * a + w.critical_dt * w.critical_dt) - a;
  }
  w.dt = w.step_monitor.first_dt = o.safety * w.critical_dt;  // (P11)
  set_bond_dashpots(w);
}

void revise_step(World& w) {
  set_contact_dashpots(w);
  sync(w);  // what is broken and open no longer counts
  const StepScene scene = step_scene(w);
  StepMonitor& monitor = w.step_monitor;
  const std::vector<std::size_t> added = uncounted(w.contacts, monitor.counted);
  if (added.empty() || stability_number_bound(scene, added, w.dt) <= monitor.margin) return;  // (B44)
  monitor.counted = pairs_of(w.contacts);
  if (stands_near(scene, added, w.dt, monitor)) return;
  constexpr int most_looks = 3;  // one finds the step, the next confirms it, or mends its aim
  for (int look_number = 0; look_number < most_looks; ++look_number) {
    ++monitor.looks;
    const bool first = look_number == 0;
    const StepEstimate look = estimate_step(scene, w.dt, first ? largest_number : 0.0);
    monitor.margin = 1.0 - look.number / largest_number;
    // the look at a lowered step says how well the one before has aimed
    const bool well_aimed = first || w.dt <= 1.005 * w.options.safety * look.critical;
    if (monitor.margin >= 0.0 && well_aimed) return;
    w.critical_dt = std::min(w.critical_dt, look.critical);
    w.dt = std::min(w.dt, w.options.safety * w.critical_dt);
    set_dashpots(w);
  }
}

}  // namespace breccia
