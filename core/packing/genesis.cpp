#include "core/packing/genesis.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/packing/packing.hpp"
#include "core/packing/relax.hpp"

namespace breccia::packing {
namespace {

// Area fraction where frictionless discs begin to press each other, and d(pressure/k_n)/d(ln r)
// beyond: first guesses, the search corrects both. Of pressure = z phi/pi (overlap/d) k_n with
// coordination z = 5.
constexpr double jammed = 0.84, first_slope = 1.4;

constexpr double pressure_error = 0.002;
// Resultants against contact forces. Looser while the pressure is far off; ten times less at the
// end moved porosity by 1e-4 and coordination by 0.03 (10,000 discs, 0.007 k_n).
constexpr double rough = 1e-2, still = 1e-3;

double area_fraction(const Region& region, std::span<const double> r) {
  double filled = 0;
  for (const double each : r) filled += volume_of(each, region.space);
  return filled / volume(region);
}

}  // namespace

double wall_pressure(const Region& region, std::span<const double> r, std::span<const Vec3> x) {
  const Vec3 edge = extent(region);
  double pressure = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    for_each_wall(region, x[i], [&](double distance, const Vec3& inward) {
      const double force = std::max(r[i] - distance, 0.0);
      const double round = std::numbers::pi * edge.x, straight = 4 * (inward.z != 0 ? edge.x : edge.z);
      pressure += force / (region.box() ? straight : round);  // (B29)
    });
  return pressure;
}

void inflate(const Region& region, double wanted, std::span<double> r, std::span<Vec3> x,
             const std::function<void(double, double)>& progress) {
  const auto grow = [r](double by) {
    for (double& each : r) each *= std::exp(by);
  };
  double before = 0, by = 0.5 * std::log(jammed / area_fraction(region, r)) + wanted / first_slope;
  double slope = first_slope, balance = rough;
  bool at_rest = false;
  constexpr int rounds = 60;
  for (int k = 0; k < rounds; ++k) {
    grow(by);
    const double done = 1 - std::pow(0.8, k), rest = 0.2 * (1 - done);
    const RelaxStage stage{.iterations = 20'000, .linear = true, .balance = balance};
    at_rest = relax(region, stage, r, x, [&](double part, double overlap) {
      if (progress) progress(done + rest * part, overlap);
    });
    const double now = wall_pressure(region, r, x), error = std::abs(now / wanted - 1);
    if (!at_rest && balance == still) break;
    if (error < pressure_error && balance == still) return;
    if (error < 0.1) balance = still;
    // Secant, kept near what an assembly of discs can do: discs that find new places make the
    // pressure jump
    if (before > 0 && now > 0 && by != 0) slope = std::clamp((now - before) / by, 0.7, 3.0);
    before = now;
    by = (wanted - now) / slope;
  }
  if (!at_rest)
    throw BadPacking(
        "genesis_pressure",
        fmt::format("discs find no rest at {:g} k_n, they are pressed through each other or through "
                    "walls: ask for less pressure, a narrower range of sizes or more discs",
                    wanted));
  throw BadPacking("genesis_pressure",
                   fmt::format("{:g} k_n not reached, only {:g} k_n: ask for more discs", wanted, before));
}

}  // namespace breccia::packing
