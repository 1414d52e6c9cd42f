#include "drivers/studies/workprecision/runs.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "core/base/error.hpp"
#include "core/bonding/law_of_material.hpp"
#include "core/loading/strength.hpp"
#include "core/world/make_world.hpp"
#include "drivers/programs/scene_of_case.hpp"
#include "io/text/toml_node.hpp"
#include "kernels/loops/bond_pass.hpp"

namespace breccia {
namespace {

constexpr std::size_t curve_points = 250;  ///< that are kept of a run

/// The case with a recipe in place of its own.
Case with_recipe(const Case& c, const Recipe& r) {
  Case with = c;
  with.safety = r.safety;
  with.test.platen_speed = r.platen_speed;
  with.damping.scheme = r.scheme;
  with.mass_scaling = r.mass_factor > 1.0;
  with.mass_factor = r.mass_factor;
  with.damping.translation = r.damping.translation;
  with.damping.rotation = r.damping.rotation;
  with.precision = r.precision;
  with.scatter = r.scatter;
  return with;
}

Outcome outcome_of(const World& w, const LoadResult& result) {
  const CurveFindings f = read_curve(result.record.rows, result.record.mismatch, w.confinement.pressure);
  Outcome o;
  o.peak_reached = f.peak_reached;
  o.readings.curve = thinned(rising_curve(result.record.rows), curve_points);
  o.readings.peak = f.peak_deviator;
  o.readings.young = f.young_modulus.value_or(Readings::none);
  o.readings.strain_at_peak = f.strain_at_peak;
  o.run_time = result.run_time;
  o.steps = w.step;
  o.time_step = w.dt;
  o.critical_time_step = w.critical_dt;
  o.kinetic_ratio = f.kinetic_ratio;
  o.platen_mismatch = f.platen_mismatch;
  return o;
}

bool names_confinement(const TomlNode& root) {
  const auto* tables = std::get_if<TomlTable>(&root.value);
  if (!tables) return false;
  for (const auto& [name, table] : *tables)
    if (const auto* keys = std::get_if<TomlTable>(&table.value); keys && name == "test")
      return std::any_of(keys->begin(), keys->end(),
                         [](const TomlEntry& key) { return key.name == "confinement"; });
  return false;
}

}  // namespace

std::string test_of_case(const std::filesystem::path& file, const std::vector<std::string>& sets) {
  const bool set = std::any_of(sets.begin(), sets.end(),
                               [](const std::string& s) { return s.starts_with("test.confinement"); });
  return set || names_confinement(read_toml(file)) ? "triaxial" : "ucs";
}

StudyScene make_study_scene(const Case& c, const std::string& test, const std::vector<Trial>& trials,
                            int threads, Progress& progress) {
  StudyScene scene{c, test, asked_features(c), {}};
  TestCase& t = scene.c.test;
  t.confinement.resize(1);
  t.unload_at.clear();
  t.stop_after_peak = t.stop_after_peak > 0 ? std::min(t.stop_after_peak, study_drop) : study_drop;
  scene.c.frames = 0;
  for (const Trial& trial : trials) {
    if (trial.spheres > 0 || scene.ready.contains(trial.recipe.precision)) continue;
    Progress silent = make_progress(true);
    scene.ready[trial.recipe.precision] =
        make_ready(with_recipe(scene.c, trial.recipe), *find_laboratory_test(test), scene.asked, threads,
                   scene.ready.empty() ? progress : silent);
  }
  return scene;
}

bool has_single_loop(const Case& c) {
  const Material& m = c.materials.front();
  try {
    built_features(law_of(m, paper_shear_ratio(m.poisson_ratio)), asked_features(c),
                   {Precision::single, c.features.energy_ledger});
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

Recipe recipe_of(const Case& c) {
  Recipe r;
  r.safety = c.safety;
  r.platen_speed = c.test.platen_speed;
  r.scheme = c.damping.scheme;
  if (c.mass_scaling) r.mass_factor = c.mass_factor;
  r.damping = {c.damping.translation, c.damping.rotation};
  r.precision = c.precision;
  r.scatter = c.scatter;
  return r;
}

ReadySpecimen pack_for_trial(const StudyScene& scene, const Trial& trial) {
  Case c = with_recipe(scene.c, trial.recipe);
  SpecimenCase& s = c.specimen;
  if (!s.pack) s.pack = PackRequest{};
  s.pack->spheres = trial.spheres;
  s.pack->seed = trial.seed;
  s.pack->space = s.space;
  s.file.reset();
  s.centre.reset();
  s.axis = 'z';
  Progress silent = make_progress(true);
  return make_ready(c, *find_laboratory_test(scene.test), scene.asked, trial.threads, silent);
}

std::optional<Outcome> run_trial(
    const StudyScene& scene, const ReadySpecimen& ready, const Trial& trial,
    const std::function<bool()>& stop,
    const std::function<void(const World&, int, double, const CurveRow&)>& progress) {
  const Case c = with_recipe(scene.c, trial.recipe);
  Outcome outcome;
  try {
    const Assembly assembly = shaken(ready.assembly, trial.shake, trial.shake_size);
    const WorldOptions options =
        world_options(c, *find_laboratory_test(scene.test), scene.asked, trial.threads);
    const LaboratoryTest& test = *find_laboratory_test(scene.test);
    World w = make_world(assembly, material_of_run(c, test, 0, ready.factor), ready.factor, options);
    LoadHooks hooks;
    hooks.interrupted = stop;
    if (progress)
      hooks.progress = [&](int stage, double fraction, const CurveRow& row) {
        progress(w, stage, fraction, row);
      };
    LoadResult result;
    run_load_test(w, assembly, load_test(c, test, 0, ready.factor), hooks, result);
    if (result.stopped == Stopped::interrupted) return std::nullopt;
    outcome = outcome_of(w, result);
  } catch (const SimulationBroke& broke) {
    outcome.failure = broke.what();
  }
  outcome.spheres = ready.assembly.particles.size;
  outcome.bonds = ready.assembly.bonds.size;
  return outcome;
}

void run_side_by_side(std::size_t tasks, int lanes, const std::function<bool()>& stop,
                      const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  std::mutex guard;
  std::exception_ptr trouble;
  const auto lane = [&] {
    for (std::size_t k = next++; k < tasks && !stop(); k = next++) {
      try {
        work(k);
      } catch (...) {
        const std::lock_guard lock(guard);
        if (!trouble) trouble = std::current_exception();
        next = tasks;
      }
    }
  };
  {
    std::vector<std::jthread> threads;  // joined in any case, also where one more cannot be started
    for (int k = 0; k < lanes && static_cast<std::size_t>(k) < tasks; ++k) threads.emplace_back(lane);
  }
  if (trouble) std::rethrow_exception(trouble);
}

}  // namespace breccia
