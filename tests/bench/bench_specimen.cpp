// Reading a specimen, and checking it: the time must grow as the number of spheres does, not as its
// square. Run from a quiet machine:
//   build/bin/bench_specimen
// The last two lines of each give the growth that fits best: N, or N lg N where something is
// sorted.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <random>

#include "io/specimens/read_specimen.hpp"

namespace {

using namespace breccia;

Specimen scattered(std::size_t spheres) {
  Specimen s;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> position(-1, 1);
  for (Gid id = 1; id <= spheres; ++id)
    s.spheres.push_back(
        {.id = id, .centre = {position(random), position(random), position(random)}, .radius = 0.01});
  return s;
}

void read(benchmark::State& state) {
  const auto file = std::filesystem::temp_directory_path() / "breccia-bench-specimen.csv";
  write_specimen_csv(file, scattered(static_cast<std::size_t>(state.range(0))));
  for (auto _ : state) benchmark::DoNotOptimize(read_specimen(file));
  state.SetComplexityN(state.range(0));
  std::filesystem::remove(file);
}

void place_and_check(benchmark::State& state) {
  const Specimen s = scattered(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) check_specimen(place_specimen(s, 'y'), {Shape::box, 2.1, 2.1, 2.1});
  state.SetComplexityN(state.range(0));
}

BENCHMARK(read)->RangeMultiplier(4)->Range(16 << 10, 1 << 20)->Unit(benchmark::kMillisecond)->Complexity();
BENCHMARK(place_and_check)
    ->RangeMultiplier(4)
    ->Range(16 << 10, 1 << 20)
    ->Unit(benchmark::kMillisecond)
    ->Complexity();

}  // namespace

BENCHMARK_MAIN();
