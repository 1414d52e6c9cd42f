#include "core/packing/sizes.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/base/error.hpp"

namespace breccia::packing {
namespace {

constexpr double tail =
    3;  // log-normal, in standard deviations: beyond it 0.3 % of the spheres, up to x10 in volume

/// Standard normal, cut at +-tail: the value below which a fraction u lies. By bisection: exact to the last
/// bits, and cheap beside the packing itself.
double normal_quantile(double u) {
  const auto below = [](double t) { return 0.5 * std::erfc(-t / std::numbers::sqrt2); };
  const double p = below(-tail) + u * (below(tail) - below(-tail));
  double lo = -tail, hi = tail;
  for (int k = 0; k < 50; ++k) {
    const double middle = 0.5 * (lo + hi);
    (below(middle) < p ? lo : hi) = middle;
  }
  return 0.5 * (lo + hi);
}

/// One class between two sieves. Mass is spread evenly over ln d (a straight line on the usual
/// semi-logarithmic plot), so the density of the number of spheres over ln d falls as d^-3 (discs: d^-2).
struct SieveClass {
  double finest, coarsest;  // m, diameters
  double number;            // spheres up to a common factor, then their cumulative fraction
  int dimensions;
  double diameter(double u) const {
    const double a = std::pow(finest, -dimensions), b = std::pow(coarsest, -dimensions);
    return std::pow(a + u * (b - a), -1.0 / dimensions);
  }
};

std::vector<SieveClass> classes(const SizeDistribution& sizes, std::size_t n, int dimensions) {
  const auto& d = sizes.sieve_openings;
  const auto& passing = sizes.sieve_passing;
  std::vector<SieveClass> all;
  double sum = 0;
  for (std::size_t k = 1; k < d.size(); ++k) {
    const double mass = passing[k] - passing[k - 1];
    if (mass <= 0) continue;  // gap-graded
    const double number =
        mass * (std::pow(d[k - 1], -dimensions) - std::pow(d[k], -dimensions)) / std::log(d[k] / d[k - 1]);
    all.push_back({d[k - 1], d[k], number, dimensions});
    sum += number;
  }
  double below = 0;
  for (auto& c : all) {
    if (const double spheres = c.number / sum * static_cast<double>(n); spheres < 1)
      fail<BadInput>(
          "sieve class {:g} to {:g} m would hold {:.2g} of the {} spheres: ask for more spheres or drop fine "
          "sieves",
          c.finest, c.coarsest, spheres, n);
    c.number = below += c.number / sum;
  }
  return all;
}

double sieve_diameter(const std::vector<SieveClass>& all, double u) {
  double below = 0;
  for (const auto& c : all) {
    if (u < c.number) return c.diameter((u - below) / (c.number - below));
    below = c.number;
  }
  return all.back().coarsest;
}

}  // namespace

void check_sizes(const SizeDistribution& sizes) {
  using Kind = SizeDistribution::Kind;
  if (sizes.kind == Kind::lognormal && !(sizes.spread >= 0 && sizes.spread <= 0.7))
    fail<BadInput>("log-normal sizes: spread {:g} is not between 0 and 0.7 (standard deviation of ln r)",
                   sizes.spread);
  if (sizes.kind == Kind::uniform && !(sizes.spread >= 0 && sizes.spread <= 0.9))
    fail<BadInput>("uniform sizes: spread {:g} is not between 0 and 0.9 (half-width over mean)",
                   sizes.spread);
  if (sizes.kind != Kind::sieves) return;

  const auto& d = sizes.sieve_openings;
  const auto& passing = sizes.sieve_passing;
  if (d.size() < 2 || d.size() != passing.size())
    fail<BadInput>(
        "sieves: {} openings and {} passing fractions; two or more of each, as many of one as of the other",
        d.size(), passing.size());
  for (std::size_t k = 0; k < d.size(); ++k) {
    if (!(std::isfinite(d[k]) && d[k] > (k ? d[k - 1] : 0.0)))
      fail<BadInput>("sieves: opening {:g} m does not exceed the one before it or zero", d[k]);
    if (!(passing[k] >= (k ? passing[k - 1] : 0.0) && passing[k] <= 1 + 1e-9))
      fail<BadInput>("sieves: passing {:g} at {:g} m does not rise from 0 to 1", passing[k], d[k]);
  }
  if (passing.front() > 1e-9)
    fail<BadInput>(
        "sieves: {:g} of the mass is finer than the first opening, {:g} m: add the opening that nothing "
        "passes",
        passing.front(), d.front());
  if (passing.back() < 1 - 1e-9)
    fail<BadInput>("sieves: only {:g} passes the last opening, {:g} m: add the one that everything passes",
                   passing.back(), d.back());
}

std::vector<double> draw_radii(const SizeDistribution& sizes, std::size_t n, Random& random, Space space) {
  using Kind = SizeDistribution::Kind;
  const int dimensions = space == Space::two_d ? 2 : 3;
  const auto all = sizes.kind == Kind::sieves ? classes(sizes, n, dimensions) : std::vector<SieveClass>{};
  std::vector<double> radii(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double u = (static_cast<double>(i) + uniform01(random)) / static_cast<double>(n);
    switch (sizes.kind) {
      case Kind::lognormal:
        radii[i] = std::exp(sizes.spread * normal_quantile(u));
        break;
      case Kind::uniform:
        radii[i] = 1 + sizes.spread * (2 * u - 1);
        break;
      case Kind::sieves:
        radii[i] = sieve_diameter(all, u) / 2;
        break;
    }
  }
  std::sort(radii.begin(), radii.end(), std::greater<>());
  return radii;
}

}  // namespace breccia::packing
