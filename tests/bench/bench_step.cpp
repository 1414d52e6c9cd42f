// Microbenchmarks of the step and its parts. Run from a quiet machine:
//   build/bin/bench_step --benchmark_filter=pass --benchmark_repetitions=5
// Arguments in the names: thousands of spheres, threads, state of the bonds. items_per_second
// counts bonds (particles for `integrate`); `best_ns` is the fastest single pass, nanoseconds per
// item, which other work on the machine disturbs least.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <map>

#include "core/bonding/law_of_material.hpp"
#include "core/stepping/step.hpp"
#include "core/world/energies.hpp"
#include "core/world/loop_views.hpp"
#include "core/world/make_world.hpp"
#include "core/world/single_precision.hpp"
#include "tests/scene.hpp"

namespace {

using namespace breccia;

constexpr Body body{Shape::cylinder, 0.15, 0, 0.3};

const Specimen& packing(std::size_t spheres) {
  static std::map<std::size_t, Specimen> made;
  const auto [at, is_new] = made.try_emplace(spheres);
  if (is_new) {
    PackRequest request;
    request.spheres = spheres;
    at->second = pack_spheres(body, request);
  }
  return at->second;
}

/// 0: intact. 1: of the bonds a tenth yields in compression, a twentieth is damaged, a twentieth
/// broken.
void put_into_state(World& w, int state) {
  BondTable& b = w.bonds;
  std::uint64_t random = 1;
  for (std::size_t k = 0; k < b.size && state == 1; ++k) {
    random = random * 6364136223846793005u + 1442695040888963407u;
    const double u = static_cast<double>(random >> 40) / double(1 << 24);
    if (u < 0.1) {
      b.rest_length[k] *= 1.002;
      b.plastic_stretch[k] = -1e-4 * b.rest_length[k];
    } else if (u < 0.15) {
      b.damage_normal[k] = 0.5;
    } else if (u < 0.2) {
      b.damage_normal[k] = 1.0;
    }
  }
}

World world(const benchmark::State& s, ScatterKind scatter = ScatterKind::private_sums,
            Precision precision = Precision::full, const Features& features = {}) {
  WorldOptions options;
  options.threads = static_cast<int>(s.range(1));
  options.scatter = scatter;
  options.precision = precision;
  AreaFactor factor;
  factor.alpha = 0.8;
  factor.shear_ratio = 0.33;
  options.features = features;
  const Material material = scene::material_of({});
  const Assembly a = assemble(packing(static_cast<std::size_t>(s.range(0)) * 1000), body, {},
                              built_features(law_of(material, factor.shear_ratio), features), 2);
  World w = make_world(a, material, factor, options);
  put_into_state(w, static_cast<int>(s.range(2)));
  fill_single(w);
  w.platens.velocity = {Vec3{0, 0, 0.02}, Vec3{0, 0, -0.02}};
  for (int k = 0; k < 20; ++k) advance(w);
  return w;
}

/// Times each call by itself: the benchmark's mean, and the best of all.
template <class Work>
void time_each(benchmark::State& s, std::size_t items, const Work& work) {
  double best = 1e9;
  for (auto _ : s) {
    const auto start = std::chrono::steady_clock::now();
    work();
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  s.SetItemsProcessed(static_cast<std::int64_t>(items) * static_cast<std::int64_t>(s.iterations()));
  s.counters["best_ns"] = 1e9 * best / static_cast<double>(items);
}

void whole_step(benchmark::State& s, ScatterKind scatter, Precision precision = Precision::full,
                const Features& features = {}) {
  World w = world(s, scatter, precision, features);
  time_each(s, w.bonds.size, [&] { advance(w); });
  for (const Phase phase : {Phase::bonds, Phase::gather, Phase::integrate})
    s.counters[std::string(phase_names[static_cast<std::size_t>(phase)])] =
        w.phases[phase] / w.phases.total();
}

/// The bond pass alone, one thread, sums included; nothing moves.
void pass(benchmark::State& s) {
  World w = world(s);
  ParticleTable& p = w.particles;
  BondTable& b = w.bonds;
  const Scatter to = scatter_view(w.bond_plan, b.row_lo, b.row_hi, b.arm_offset, p);
  const BondPassIn in = bond_pass_in(w);
  const BondPassHistory history = bond_pass_history(w);
  time_each(s, b.size, [&] { w.bond_pass(in, history, 0, b.padded, to, nullptr); });
}

/// The energy that the bonds store, as every row of a curve has it.
void energy(benchmark::State& s) {
  World w = world(s);
  time_each(s, w.bonds.size, [&] { benchmark::DoNotOptimize(stored_energy(w)); });
}

void states(benchmark::internal::Benchmark* b) {
  for (const int spheres : {14, 66})
    for (const int threads : {1, 2})
      for (const int state : {0, 1}) b->Args({spheres, threads, state});
  b->UseRealTime();
}

void intact(benchmark::internal::Benchmark* b) {
  for (const int spheres : {14, 66}) b->Args({spheres, 1, 0});
  b->UseRealTime();
}

BENCHMARK(pass)->Args({14, 1, 0})->Args({14, 1, 1})->Args({66, 1, 0})->Args({66, 1, 1});
BENCHMARK(energy)->Args({14, 1, 0})->Args({14, 1, 1})->Args({66, 1, 0});
BENCHMARK_CAPTURE(whole_step, private, ScatterKind::private_sums)->Apply(states);
// what a scene leaves out
constexpr ScatterKind sums = ScatterKind::private_sums;
BENCHMARK_CAPTURE(whole_step, no_rotation, sums, Precision::full, Features{.rotation = false})->Apply(intact);
BENCHMARK_CAPTURE(whole_step, no_plasticity, sums, Precision::full, Features{.plasticity = false})
    ->Apply(intact);
BENCHMARK_CAPTURE(whole_step, elastic, sums, Precision::full,
                  Features{.plasticity = false, .breakage = false})
    ->Apply(intact);
BENCHMARK_CAPTURE(whole_step, coupled, sums, Precision::full, Features{.criterion = Criterion::coupled})
    ->Apply(intact);
BENCHMARK_CAPTURE(whole_step, single, ScatterKind::private_sums, Precision::single)->Apply(states);
BENCHMARK_CAPTURE(whole_step, gather, ScatterKind::gather)->Apply(states);

}  // namespace

BENCHMARK_MAIN();
