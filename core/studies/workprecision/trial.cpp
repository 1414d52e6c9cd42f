#include "core/studies/workprecision/trial.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/random.hpp"

namespace breccia {
namespace {

/// Reference runs, and its halves first: they take longest, and lanes are then filled evenly.
void plan_reference(const PlanOptions& o, std::vector<Trial>& trials) {
  Trial trial;
  trial.purpose = Purpose::half_speed;
  trial.recipe = reference_recipe(o.grid, o.base);
  const Recipe whole = trial.recipe;
  trial.recipe.platen_speed *= 0.5;
  trials.push_back(trial);
  trial.purpose = Purpose::half_step;
  trial.recipe = whole;
  trial.recipe.safety *= 0.5;
  trials.push_back(trial);
  trial.purpose = Purpose::reference;
  trial.recipe = whole;
  trials.push_back(trial);
  trial.shake_size = o.grid.shake_size;
  for (trial.shake = 1; trial.shake < o.grid.shakes; ++trial.shake) trials.push_back(trial);
}

void plan_sizes(const PlanOptions& o, std::vector<Trial>& trials) {
  Trial trial;
  trial.purpose = Purpose::size;
  trial.family = Family::sizes;
  trial.recipe = o.base;
  // the largest first, for lanes that end together
  for (auto spheres = o.grid.spheres.rbegin(); spheres != o.grid.spheres.rend(); ++spheres)
    for (int seed = 1; seed <= o.grid.seeds; ++seed) {
      trial.spheres = *spheres;
      trial.seed = static_cast<std::uint64_t>(seed);
      trials.push_back(trial);
    }
  if (o.grid.large == 0) return;
  trial.spheres = o.grid.large;
  trial.seed = 1;
  trial.threads = o.threads;
  trial.timed = true;
  for (const double speed : o.grid.large_speeds) {
    trial.recipe.platen_speed = speed;
    trials.push_back(trial);
  }
}

}  // namespace

std::string_view name_of(Purpose purpose) {
  switch (purpose) {
    case Purpose::reference:
      return "reference";
    case Purpose::half_step:
      return "half_step";
    case Purpose::half_speed:
      return "half_speed";
    case Purpose::recipe:
      return "recipe";
    case Purpose::size:
      return "size";
  }
  return "?";
}

std::string key_of(const Trial& t) {
  const std::string specimen =
      t.spheres ? fmt::format("{} spheres, seed {}", t.spheres, t.seed) : "the case's";
  const std::string shake =
      t.shake ? fmt::format("; positions times 1 + {:g} u, seed {}", t.shake_size, t.shake) : "";
  return fmt::format("{}; {}{}; {} thread{}{}", describe(t.recipe), specimen, shake, t.threads,
                     t.threads == 1 ? "" : "s", t.timed ? ", alone" : "");
}

Recipe reference_recipe(const Grid& grid, const Recipe& base) {
  Recipe r;
  r.safety = grid.reference_safety;
  r.platen_speed = grid.reference_speed;
  r.damping = base.damping;
  return r;
}

std::vector<Trial> plan_trials(const PlanOptions& o) {
  std::vector<Trial> trials, different;
  plan_reference(o, trials);
  for (const GridRecipe& one : grid_recipes(o.grid, o.base, o.families)) {
    if (one.recipe.precision == Precision::single && !o.single) continue;
    Trial trial;
    trial.family = one.family;
    trial.recipe = one.recipe;
    trial.threads = o.threads;
    trial.timed = true;
    trials.push_back(trial);
  }
  if (std::find(o.families.begin(), o.families.end(), Family::sizes) != o.families.end())
    plan_sizes(o, trials);
  for (const Trial& trial : trials)
    if (std::none_of(different.begin(), different.end(),
                     [&](const Trial& other) { return key_of(other) == key_of(trial); }))
      different.push_back(trial);
  return different;
}

Assembly shaken(Assembly assembly, int number, double size) {
  if (number == 0) return assembly;
  Random random(static_cast<std::uint64_t>(number));
  const auto shake = [&](double& x) { x *= 1.0 + size * (2.0 * uniform01(random) - 1.0); };
  ParticleTable& p = assembly.particles;
  for (std::size_t row = 0; row < p.size; ++row) {
    for (double* x : {&p.position[row].x, &p.position[row].y, &p.position[row].z}) shake(*x);
    p.reference_position[row] = p.position[row];
  }
  return assembly;
}

}  // namespace breccia
