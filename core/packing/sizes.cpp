#include "core/packing/sizes.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/base/error.hpp"

namespace breccia::packing {
namespace {

template <class... Args>
[[noreturn]] void refuse(std::string_view key, fmt::format_string<Args...> text, Args&&... args) {
  throw BadPacking(std::string(key), fmt::format(text, std::forward<Args>(args)...));
}

constexpr double tail =
    3;  // log-normal, in standard deviations: beyond it 0.3 % of the spheres, up to x10 in volume

/// Standard normal, cut at +-tail: the value below which a fraction u lies. By bisection: exact to
/// the last bits, and cheap beside the packing itself.
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
/// semi-logarithmic plot), so the density of the number of spheres over ln d falls as d^-3 (discs:
/// d^-2).
struct SieveClass {
  double finest, coarsest;  // m, diameters
  double number;            // spheres up to a common factor, then their cumulative fraction
  int dimensions;
  double diameter(double u) const {
    const double a = std::pow(finest, -dimensions), b = std::pow(coarsest, -dimensions);
    return std::pow(a + u * (b - a), -1.0 / dimensions);
  }
};

/// The classes that hold anything, and the sum of their numbers.
std::vector<SieveClass> classes(const SizeDistribution& sizes, int dimensions, double& sum) {
  const auto& d = sizes.sieve_openings;
  const auto& passing = sizes.sieve_passing;
  std::vector<SieveClass> all;
  sum = 0;
  for (std::size_t k = 1; k < d.size(); ++k) {
    const double mass = passing[k] - passing[k - 1];
    if (mass <= 0) continue;  // gap-graded
    const double number =
        mass * (std::pow(d[k - 1], -dimensions) - std::pow(d[k], -dimensions)) / std::log(d[k] / d[k - 1]);
    all.push_back({d[k - 1], d[k], number, dimensions});
    sum += number;
  }
  return all;
}

/// Classes with their cumulative fractions of n spheres, each of at least one.
std::vector<SieveClass> filled_classes(const SizeDistribution& sizes, std::size_t n, int dimensions) {
  double sum = 0, below = 0;
  std::vector<SieveClass> all = classes(sizes, dimensions, sum);
  for (auto& c : all) {
    if (const double spheres = c.number / sum * static_cast<double>(n); spheres < 1)
      refuse(
          "sizes.openings",
          "the sieve class from {:g} to {:g} m would hold {:.2g} of the {} spheres: leave out what is finer "
          "with sizes.finest, or pack a larger body",
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
  using namespace pack_limits;
  const auto check_spread = [&](double most, std::string_view what) {
    if (!(sizes.spread >= 0 && sizes.spread <= most))
      refuse("sizes.spread", "must be from 0 to {:g} ({}), not {:g}", most, what, sizes.spread);
  };
  if (sizes.kind == Kind::lognormal)
    check_spread(most_spread_lognormal, "log-normal: standard deviation of ln r");
  if (sizes.kind == Kind::uniform) check_spread(most_spread_uniform, "uniform: half-width over mean");
  if (sizes.kind != Kind::sieves) return;

  const auto& d = sizes.sieve_openings;
  const auto& passing = sizes.sieve_passing;
  if (d.size() < 2 || d.size() != passing.size())
    refuse("sizes.passing", "{} values for {} openings; give as many of both, two or more", passing.size(),
           d.size());
  for (std::size_t k = 0; k < d.size(); ++k) {
    if (!(std::isfinite(d[k]) && d[k] > (k ? d[k - 1] : 0.0)))
      refuse("sizes.openings", "{:g} m does not exceed the one before it or zero", d[k]);
    if (!(passing[k] >= (k ? passing[k - 1] : 0.0) && passing[k] <= 1 + 1e-9))
      refuse("sizes.passing", "{:g} at {:g} m does not rise from 0 to 1", passing[k], d[k]);
  }
  if (passing.front() > 1e-9)
    refuse(
        "sizes.passing",
        "must begin with 0: {:g} of the mass is finer than the first opening, {:g} m; add the opening that "
        "nothing passes",
        passing.front(), d.front());
  if (passing.back() < 1 - 1e-9)
    refuse("sizes.passing",
           "must end with 1: only {:g} passes the last opening, {:g} m; add the one that everything passes",
           passing.back(), d.back());
  if (sizes.finest >= d.back())
    refuse("sizes.finest", "{:g} m leaves nothing of openings up to {:g} m", sizes.finest, d.back());
}

double spheres_per_volume(const SizeDistribution& sizes, Space space) {
  // a class of mass m, even over ln d, has m/ln(d1/d0) (6/pi) (d0^-3 - d1^-3)/3 spheres in a cubic
  // metre of solid, or m/ln(d1/d0) (4/pi) (d0^-2 - d1^-2)/2 discs
  double sum = 0;
  classes(sizes, space == Space::two_d ? 2 : 3, sum);
  return 2 / std::numbers::pi * sum;
}

SizeDistribution without_fines(const SizeDistribution& sizes, double finest) {
  const auto& d = sizes.sieve_openings;
  if (!(finest > d.front())) return sizes;
  std::size_t k = 1;  // the first opening above
  while (k + 1 < d.size() && !(d[k] > finest)) ++k;
  const auto& passing = sizes.sieve_passing;
  const double part = std::log(finest / d[k - 1]) / std::log(d[k] / d[k - 1]);
  const double left_out = passing[k - 1] + part * (passing[k] - passing[k - 1]);
  SizeDistribution cut = sizes;
  cut.finest = 0;
  cut.sieve_openings = {finest};
  cut.sieve_passing = {0};
  for (; k < d.size(); ++k) {
    cut.sieve_openings.push_back(d[k]);
    cut.sieve_passing.push_back((passing[k] - left_out) / (1 - left_out));
  }
  return cut;
}

void fit_within_classes(const SizeDistribution& all, double wanted, std::vector<double>& radii, Space space) {
  const SizeDistribution sizes = without_fines(all, all.finest);
  const auto& d = sizes.sieve_openings;
  const auto sum_of = [&](const std::vector<double>& r) {
    double sum = 0;
    for (const double each : r) sum += space == Space::two_d ? each * each : each * each * each;
    return sum;
  };
  const bool coarser = sum_of(radii) < wanted;
  // d = edge (d/edge)^power stays between the edge of its class and itself
  const auto moved = [&](double power) {
    std::vector<double> r = radii;
    for (double& each : r) {
      std::size_t k = 1;
      while (k + 1 < d.size() && d[k] < 2 * each) ++k;
      const double edge = 0.5 * d[coarser ? k : k - 1];
      each = edge * std::pow(each / edge, power);
    }
    return r;
  };
  double low = 0, high = 1;  // powers: 0 moves all to the edges, 1 nothing
  if (coarser ? sum_of(moved(low)) < wanted : sum_of(moved(low)) > wanted)
    refuse("sizes.openings", "{} spheres are too few for this grading: pack a larger body", radii.size());
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    ((sum_of(moved(middle)) < wanted) == coarser ? high : low) = middle;
  }
  radii = moved(0.5 * (low + high));
}

std::vector<double> draw_radii(const SizeDistribution& sizes, std::size_t n, Random& random, Space space) {
  using Kind = SizeDistribution::Kind;
  const int dimensions = space == Space::two_d ? 2 : 3;
  const auto all = sizes.kind == Kind::sieves
                       ? filled_classes(without_fines(sizes, sizes.finest), n, dimensions)
                       : std::vector<SieveClass>{};
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
