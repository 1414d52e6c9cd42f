#include "core/studies/layouts/layout_study.hpp"

#include <algorithm>
#include <cmath>

#include "core/bonding/assembly.hpp"
#include "core/packing/packing.hpp"
#include "core/stepping/step.hpp"
#include "core/studies/layouts/wall_time.hpp"
#include "core/world/make_world.hpp"

namespace breccia {
namespace {

/// The result of three passes with production's step, from the scene's state.
PassResult three_passes(LayoutRun& run, double dt) {
  for (int k = 0; k < 3; ++k) {
    run.clear_sums();
    run.pass(dt);
  }
  return run.result();
}

/// Passes that fill a block.
std::size_t passes_for(LayoutRun& run, double dt, double seconds) {
  run.pass(dt);
  std::size_t passes = 1;
  for (;;) {
    const double took = wall_time([&] {
      for (std::size_t k = 0; k < passes; ++k) run.pass(dt);
    });
    if (took >= 0.25 * seconds)
      return std::max<std::size_t>(
          1, static_cast<std::size_t>(std::lround(static_cast<double>(passes) * seconds / took)));
    passes *= 2;
  }
}

double time_block(LayoutRun& run, double dt, std::size_t passes) {
  run.clear_sums();
  run.pass(dt);  // the caches hold another layout
  return wall_time([&] {
    for (std::size_t k = 0; k < passes; ++k) run.pass(dt);
  });
}

}  // namespace

LayoutScene make_layout_scene(std::size_t spheres, const Material& material, int threads,
                              const std::function<void(double)>& progress) {
  const Body body{Shape::cylinder, 0.15, 0, 0.3};
  PackRequest request;
  request.spheres = spheres;
  const Specimen specimen = pack_spheres(body, request, [&](double fraction, double) { progress(fraction); });
  const Assembly assembly = assemble(specimen, body, {}, Features{}, threads);
  AreaFactor factor;
  factor.alpha = 0.8;
  factor.shear_ratio = 0.33;
  WorldOptions options;
  options.threads = threads;
  options.cracks = false;
  LayoutScene scene{make_world(assembly, material, factor, options), {}};
  World& w = scene.world;
  w.platens.velocity = {Vec3{0, 0, 0.2}, Vec3{0, 0, -0.2}};  // m/s
  for (int k = 0; k < 20; ++k) advance(w);
  scene.bytes = {single_bytes_per_bond(w.bonds, w.particles), bytes_per_bond(w.bonds, w.particles)};
  return scene;
}

std::vector<LayoutResult> study_layouts(const LayoutScene& scene, int threads, const LayoutTiming& timing) {
  const World& w = scene.world;
  const double bonds = static_cast<double>(w.bonds.size);
  // so short a step that the state stays the same over all passes; the time of a pass does not
  // depend on it
  const double dt = 1e-6 * w.dt;

  const MachinePeak peak = measure_peak(w.options.instruction_set, threads, scene.bytes.full.set * bonds,
                                        timing.repeat, timing.block_seconds);
  const MachinePeak single_peak =
      measure_peak(w.options.instruction_set, threads, scene.bytes.single.set * bonds, timing.repeat,
                   timing.block_seconds);
  // a register holds twice as many floats as doubles
  const Both<PassLimit> limit{
      limit_of(single_peak, scene.bytes.single.moved(),
               0.5 * static_cast<double>(single_operations_per_bond().total())),
      limit_of(peak, scene.bytes.full.moved(), static_cast<double>(operations_per_bond().total()))};
  LayoutRun production(w, {}, 1);
  const PassResult wanted = three_passes(production, w.dt);

  std::vector<LayoutRun> runs;
  runs.reserve(layouts.size());
  std::vector<LayoutResult> results;
  for (const Layout& layout : layouts) {
    LayoutRun& run = runs.emplace_back(w, layout, threads);
    LayoutResult& r = results.emplace_back();
    r.layout = layout;
    r.colours = run.colours();
    r.peak = layout.precision == Precision::single ? single_peak : peak;
    r.limit = limit.of(layout.precision);
    r.difference = largest_difference(wanted, three_passes(run, w.dt));
    r.passes = passes_for(run, dt, timing.block_seconds);
  }
  for (int block = 0; block < timing.repeat; ++block)
    for (std::size_t k = 0; k < runs.size(); ++k)
      results[k].block_ns.push_back(1e9 * time_block(runs[k], dt, results[k].passes) /
                                    (static_cast<double>(results[k].passes) * bonds));
  return results;
}

}  // namespace breccia
