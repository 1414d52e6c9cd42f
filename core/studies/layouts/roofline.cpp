#include "core/studies/layouts/roofline.hpp"

#include <tbb/cache_aligned_allocator.h>

#include <algorithm>
#include <atomic>
#include <vector>

#include "core/base/threads.hpp"
#include "core/studies/layouts/machine_rates.hpp"
#include "core/studies/layouts/wall_time.hpp"

namespace breccia {
namespace {

/// Largest amount per second over `repeat` tries. `work(rounds)` does rounds times `amount`.
template <class Work>
double best_rate(double amount, int repeat, double seconds, const Work& work) {
  std::size_t rounds = 1;
  double took = wall_time([&] { work(rounds); });
  while (took < 0.5 * seconds) {
    rounds *= 2;
    took = wall_time([&] { work(rounds); });
  }
  double best = 0;
  for (int k = 0; k < repeat; ++k)
    best = std::max(best, amount * static_cast<double>(rounds) / wall_time([&] { work(rounds); }));
  return best;
}

}  // namespace

MachinePeak measure_peak(InstructionSet set, int threads, double set_bytes, int repeat, double seconds) {
  const MachineRates& rates = machine_rates(set);
  constexpr std::size_t line = 8;  // doubles; ranges begin with a line of the cache
  const auto values = static_cast<std::size_t>(set_bytes / (4 * sizeof(double))) / line * line + line;
  using Column = std::vector<double, tbb::cache_aligned_allocator<double>>;
  const Column a(values, 1.0), b = a, c = a;
  Column d = a;
  MachinePeak peak;
  // a written line is fetched first, as in the pass: five values moved
  peak.bandwidth =
      best_rate(5.0 * sizeof(double) * static_cast<double>(values), repeat, seconds, [&](std::size_t sweeps) {
        for_ranges(threads, [&](int range) {
          rates.stream({a.data(), b.data(), c.data(), d.data()}, range_first(values, range, threads, line),
                       range_first(values, range + 1, threads, line), sweeps);
        });
      });
  std::atomic<double> kept = 0;  // so that nothing is left out
  peak.operations = best_rate(rates.operations_per_round * threads, repeat, seconds, [&](std::size_t rounds) {
    for_ranges(threads, [&](int) { kept = rates.multiply_add(rounds); });
  });
  return peak;
}

}  // namespace breccia
