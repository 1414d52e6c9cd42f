#include "core/studies/stability/run.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <span>

#include "core/base/error.hpp"
#include "core/bonding/law_of_material.hpp"
#include "core/checks/stability_checks.hpp"
#include "core/elastic/area_factor.hpp"
#include "core/stepping/step.hpp"
#include "core/studies/stability/exact_limit.hpp"
#include "core/world/energies.hpp"
#include "core/world/loop_views.hpp"
#include "core/world/make_world.hpp"
#include "core/world/single_precision.hpp"
#include "core/world/stable_step.hpp"
#include "core/world/sync.hpp"

namespace breccia {
namespace {

/// A network has nobody held, no loss but the dashpots of a damped one, and nothing that is not
/// linear.
void make_linear(WorldOptions& options, StabilityPart part) {
  options.features.plasticity = options.features.breakage = false;
  options.new_contacts = false;
  options.global_damping = {};
  if (part == StabilityPart::network) options.contact_damping = 0.0;
}

/// Random velocities and spins, without net momentum, so small that nothing departs from the linear
/// network: strains near 1e-6, and in a step no bond turns by more than 1e-4.
void shake(World& w) {
  const std::span<const double> lengths = std::span(w.bonds.rest_length).first(w.bonds.size);
  const double speed = std::min(1e-6 * std::sqrt(w.material.young_modulus / w.material.density),
                                1e-4 * *std::min_element(lengths.begin(), lengths.end()) / w.dt);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> in(-speed, speed);
  ParticleTable& p = w.particles;
  Vec3 momentum;
  double mass = 0.0;
  for (std::size_t k = 0; k < p.size; ++k) {
    p.velocity[k] = {in(random), in(random), in(random)};
    const double per_radius = 1.0 / p.radius[k];
    p.spin[k] = per_radius * Vec3{in(random), in(random), in(random)};
    momentum += p.mass[k] * p.velocity[k];
    mass += p.mass[k];
  }
  for (Vec3& v : p.velocity) v -= (1.0 / mass) * momentum;
}

/// J, of places as the table has them now, in either precision.
double stored_by_tables(World& w) {
  sync(w);
  SingleStore aside;
  std::swap(aside, w.single);
  const double stored = stored_energy(w);
  std::swap(aside, w.single);
  return stored;
}

/// J, kinetic and stored at the instant whose forces the step finds: with the velocities half a
/// step before and after it, which is what the scheme conserves (B48). Makes the step.
double advance_with_energy(World& w) {
  ParticleTable& p = w.particles;
  const Column<Vec3> place = p.position.copy(), velocity = p.velocity.copy(), spin = p.spin.copy();
  advance(w);
  double kinetic = 0.0;
  for (std::size_t k = 0; k < p.size; ++k)
    kinetic += 0.5 * (p.mass[k] * dot(velocity[k], p.velocity[k]) +
                      inertia(inertia_factor(w), p.mass[k], p.radius[k]) * dot(spin[k], p.spin[k]));
  const Column<Vec3> moved = p.position.copy();
  p.position.fill(place);
  const double stored = stored_by_tables(w);
  p.position.fill(moved);
  return kinetic + stored;
}

/// What the scheme conserves, over a run, held against its start. It is conserved above the limit
/// too, where its kinetic part is large and negative: it tells errors, never growth.
class EnergyBook {
public:
  explicit EnergyBook(std::uint64_t steps) : last_tenth_(steps - steps / 10) {}
  void add(std::uint64_t step, double energy) {
    if (start_ == 0.0) start_ = energy;
    largest_ = std::max(largest_, std::abs(energy - start_));
    if (step < last_tenth_) return;
    sum_ += energy;
    ++looks_;
  }
  double error() const { return largest_ / start_; }
  double drift() const { return looks_ ? sum_ / looks_ / start_ - 1.0 : StabilityRun::none; }

private:
  std::uint64_t last_tenth_;
  double start_ = 0, largest_ = 0, sum_ = 0;
  int looks_ = 0;
};

constexpr std::uint64_t steps_between_looks = 20;

/// True where energy as it is at one time, of velocities half a step old, has left all bounds.
bool has_run_away(const World& w, double start) {
  constexpr double runaway = 1e9;
  return !(kinetic_energy(w) + stored_energy(w) < runaway * start);
}

/// Whether a run that was stopped would have run away: it goes on without checks.
bool would_run_away(World& w, double start, std::uint64_t steps) {
  try {
    for (const std::uint64_t end = w.step + steps; w.step < end;) {
      advance(w);
      if (w.step % steps_between_looks == 0 && has_run_away(w, start)) return true;
    }
  } catch (const SimulationBroke&) {  // faster than single precision can tell
    return true;
  }
  return false;
}

void run_freely(World& w, std::uint64_t steps, bool has_loss, StabilityRun& run) {
  StabilityChecks checks = make_stability_checks(w);
  EnergyBook book(steps);
  double start = 0.0;
  try {
    while (w.step < steps && run.verdict == Verdict::stable) {
      if (w.step % steps_between_looks != 0) {
        advance(w);
        continue;
      }
      book.add(w.step, advance_with_energy(w));
      if (start == 0.0) start = kinetic_energy(w) + stored_energy(w);
      check(checks, w, kinetic_energy(w), stored_energy(w));
      if (has_run_away(w, start)) run.verdict = Verdict::unnoticed;
    }
    run.steps = w.step;
  } catch (const SimulationBroke& why) {
    run.cause = why.what();
    run.steps = w.step;
    run.verdict = would_run_away(w, start, steps) ? Verdict::blew_up : Verdict::stopped;
  }
  if (has_loss || run.verdict == Verdict::blew_up || run.verdict == Verdict::unnoticed) return;
  run.energy_error = book.error();
  run.drift = book.drift();
}

/// All bonds broken, every sphere on its way outwards: nothing holds, and nothing may be gained.
void run_blast(World& w, double speed, std::uint64_t steps, StabilityRun& run) {
  std::fill_n(w.bonds.damage_normal.begin(), w.bonds.size, 1.0);
  for (std::size_t k = 0; k < w.particles.size; ++k)
    w.particles.velocity[k] = (2.0 * speed / w.body.diameter) * w.particles.position[k];
  w.particles.free = w.first_top = w.particles.size;
  w.end_walls.enabled = false;
  w.options.global_damping = {};
  start_single(w);
  run_freely(w, steps, false, run);
}

double peak_of(const Recorder& record) {
  double peak = StabilityRun::none;
  for (const CurveRow& row : record.rows)
    if (!(row.axial_stress_Pa <= peak)) peak = row.axial_stress_Pa;
  return peak;
}

void run_test(StabilityWorld& made, StabilityRun& run) {
  World& w = made.world;
  LoadResult result;
  try {
    run_load_test(w, made.assembly, made.load, {}, result);
  } catch (const SimulationBroke& why) {
    run.verdict = Verdict::stopped;
    run.cause = why.what();
  }
  run.steps = w.step;
  run.energy_error = energy_error(w.ledger);
  if (run.verdict == Verdict::stable) run.peak = peak_of(result.record);
  sync(w);
  const BrokenCount broken = count_broken(w);
  run.broken = static_cast<double>(broken.tension + broken.shear);
}

/// Pressed a little, then left alone between platens that stand still.
void run_rest(StabilityWorld& made, std::uint64_t steps, StabilityRun& run) {
  World& w = made.world;
  run_test(made, run);
  if (run.verdict != Verdict::stable) return;
  w.platens.velocity = {};
  StabilityChecks checks = make_stability_checks(w);
  const std::uint64_t end = w.step + steps, settled = w.step + steps / 10;
  double start = 0.0, last = 0.0;
  try {
    while (w.step < end) {
      advance(w);
      last = axial_stress(w.platens);
      if (w.step == settled) start = last;
      if (w.step % 10'000 == 0) check(checks, w, kinetic_energy(w), stored_energy(w));
    }
    run.drift = last / start - 1.0;
  } catch (const SimulationBroke& why) {
    run.verdict = Verdict::stopped;
    run.cause = why.what();
  }
  run.steps = w.step;
  run.peak = last;
}

}  // namespace

StabilityWorld make_stability_world(const StabilityScene& scene, StabilityPart part, const Material& material,
                                    Precision precision) {
  StabilitySetup setup = plain_setup(material);
  setup.options.precision = precision;
  scene.differ(setup);
  if (part != StabilityPart::law) make_linear(setup.options, part);
  StabilityWorld made;
  setup.options.ledger = part == StabilityPart::law;
  const LoopKind loop{setup.options.precision, setup.options.ledger};
  const Features columns =
      built_features(law_of(setup.material, 1.0 / 3.0), setup.options.features, loop);  // whatever the ratio
  made.assembly = assemble(setup.specimen, setup.body, {}, columns, 1);
  AreaFactorRequest factor;
  factor.rule = AlphaRule::affine;
  factor.material = setup.material;
  made.world =
      make_world(made.assembly, setup.material, find_area_factor(made.assembly, factor, 1), setup.options);
  World& w = made.world;
  if (setup.change) {
    setup.change(w);
    w.platens =
        make_platens(made.assembly, w.particles, setup.options.rough_platens, setup.material.young_modulus);
    choose_step(w);
  }
  for (std::size_t k = 0; k < w.particles.size; ++k) {
    w.particles.position[k] += setup.offset;
    w.particles.reference_position[k] += setup.offset;
  }
  w.neighbour_list.position = w.particles.position.copy();
  for (double& place : w.end_walls.place) place += setup.offset.z;
  if (part != StabilityPart::law) {
    w.particles.free = w.first_top = w.particles.size;
    w.end_walls.enabled = false;
  }
  made.load = setup.load;
  made.blast = setup.blast;
  made.rest_steps = setup.rest_steps;
  made.exact = exact_time_step(w);
  return made;
}

StabilityRun run_stability(const StabilityScene& scene, StabilityPart part, StabilityWorld made,
                           double fraction, std::uint64_t steps, const StabilityLength& length) {
  World& w = made.world;
  StabilityRun run;
  run.scene = scene.name;
  run.stresses = scene.stresses;
  run.part = part;
  run.fraction = fraction;
  run.spheres = w.particles.size;
  run.bonds = w.bonds.size;
  run.exact_dt = made.exact;
  run.estimate_dt = w.critical_dt;
  run.dt = w.dt = fraction * made.exact;
  w.options.safety = fraction;
  w.critical_dt = made.exact;
  if (part != StabilityPart::law) shake(w);
  start_single(w);  // with the scene's own places, speeds and step
  if (part != StabilityPart::law) {
    run_freely(w, steps, part == StabilityPart::damped, run);
  } else if (made.blast > 0.0) {
    run_blast(w, made.blast, steps, run);
  } else {
    made.load.stop_strain *= length.strain;
    if (made.rest_steps > 0)
      run_rest(made, static_cast<std::uint64_t>(length.rest * static_cast<double>(made.rest_steps)), run);
    else
      run_test(made, run);
  }
  return run;
}

}  // namespace breccia
