#include "core/packing/packing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/packing/genesis.hpp"
#include "core/packing/neighbours.hpp"
#include "core/packing/region.hpp"
#include "core/packing/relax.hpp"
#include "core/packing/sizes.hpp"

namespace breccia {
namespace {

using namespace packing;

template <class... Args>
[[noreturn]] void refuse(std::string_view key, fmt::format_string<Args...> text, Args&&... args) {
  throw BadPacking(std::string(key), fmt::format(text, std::forward<Args>(args)...));
}

bool by_sieves(const PackRequest& request) { return request.sizes.kind == SizeDistribution::Kind::sieves; }

void check(const Region& region, const PackRequest& request) {
  if (region.plane() && region.body.shape == Shape::cylinder)
    fail<BadInput>("packing: a body in the plane is a box (rectangle) or a disc (circle), not a cylinder");
  const Vec3 edge = extent(region);
  for (const double length : {edge.x, edge.y, edge.z})
    if (!(std::isfinite(length) && length > 0))
      fail<BadInput>("packing: the body's dimensions {:g} x {:g} x {:g} m are not all positive", edge.x,
                     edge.y, edge.z);
  using namespace pack_limits;
  if (request.spheres == 0 && !by_sieves(request)) refuse("spheres", "0 asked for; at least 1 is needed");
  if (request.spheres > most_spheres)
    refuse("spheres", "{} asked for; at most {} are possible", request.spheres, most_spheres);
  const double least = region.plane() ? least_porosity_of_plane : least_porosity;
  if (!(request.porosity >= least && request.porosity <= most_porosity))
    refuse("porosity", "must be from {:g} to {:g}{}, not {:g}", least, most_porosity,
           region.plane() ? " in the plane" : "", request.porosity);
  if (!(request.genesis_pressure >= 0 && request.genesis_pressure <= most_genesis_pressure))
    refuse("genesis_pressure", "must be from 0 to {:g}, not {:g}", most_genesis_pressure,
           request.genesis_pressure);
  if (request.genesis_pressure > 0 && !region.plane())
    refuse("genesis_pressure", "is for discs in the plane, not for spheres");
  if (request.genesis_pressure > 0 && by_sieves(request))
    refuse("genesis_pressure", "makes the discs grow, and sieves are lengths; give a porosity instead");
  check_sizes(request.sizes);
}

void check_fit(const Region& region, double largest_radius, bool sieves) {
  const Vec3 edge = extent(region);
  if (const double most = region.plane() ? std::min(edge.x, edge.z) : std::min({edge.x, edge.y, edge.z});
      2 * largest_radius > most)
    refuse(sieves ? "sizes.openings" : "spheres",
           "the largest sphere, {:.3g} m across, is bigger than the body, {:.3g} m at its narrowest: {}",
           2 * largest_radius, most, sieves ? "leave out the coarsest sieve" : "ask for more spheres");
}

/// The number of spheres that sieves of given openings need. One that was asked for beside them
/// must be it, but for a hundredth: sizes are lengths, and are not scaled to fit.
std::size_t number_by_sieves(const Region& region, const PackRequest& request) {
  const double solid = (1 - request.porosity) * volume(region);
  const auto needed = [&](double finest) {
    return solid * spheres_per_volume(without_fines(request.sizes, finest), region.space);
  };
  const double wanted = needed(request.sizes.finest), asked = static_cast<double>(request.spheres);
  const char* of = region.plane() ? "discs" : "spheres";
  if (!(wanted < static_cast<double>(pack_limits::most_spheres)))
    refuse("sizes.openings",
           "body, porosity and grading ask for {:.3g} {}, and at most {} are possible: leave "
           "out what is finest with sizes.finest",
           wanted, of, pack_limits::most_spheres);
  const auto number = static_cast<std::size_t>(std::max(1.0, std::round(wanted)));
  if (request.spheres == 0 || std::abs(asked - wanted) <= std::max(1.0, 0.01 * wanted))
    return request.spheres == 0 ? number : request.spheres;
  std::string cut;
  if (asked < wanted) {  // how much of the fines to leave out for the number asked for
    double low = request.sizes.sieve_openings.front(), high = request.sizes.sieve_openings.back();
    for (int k = 0; k < 60; ++k) {
      const double middle = std::sqrt(low * high);
      (needed(middle) > asked ? low : high) = middle;
    }
    cut = fmt::format(", or leave out what is finer than {:.4g} mm with sizes.finest", low * 1e3);
  }
  refuse("spheres", "body, porosity and grading ask for {} {}, not {}; write {}, or leave spheres out{}",
         number, of, request.spheres, number, cut);
}

/// Scales the radii so that the sum of the spheres' volumes is (1 - porosity) of the body's.
void scale_to_porosity(const Region& region, const PackRequest& request, std::vector<double>& radii) {
  double powers = 0;
  for (const double r : radii) powers += region.plane() ? r * r : r * r * r;
  const double wanted = (1 - request.porosity) * volume(region) / volume_of(1, region.space);
  if (by_sieves(request)) {
    fit_within_classes(request.sizes, wanted, radii, region.space);
    return check_fit(region, radii.front(), true);
  }
  const double factor = region.plane() ? std::sqrt(wanted / powers) : std::cbrt(wanted / powers);
  for (double& r : radii) r *= factor;
  check_fit(region, radii.front(), false);
}

/// Halton, Numer. Math. 2 (1960) 84-90.
double radical_inverse(std::size_t index, std::size_t base) {
  double value = 0, digit = 1;
  for (; index; index /= base) {
    digit /= static_cast<double>(base);
    value += digit * static_cast<double>(index % base);
  }
  return value;
}

/// Places the largest first along a randomly shifted Halton sequence: any run of it, so any range
/// of sizes, is spread evenly over the body. Independent random points would start with more in one
/// end than in the other by chance, and no relaxation carries that far.
std::vector<Vec3> insert_evenly(const Region& region, const std::vector<double>& radii, Random& random) {
  const double a = uniform01(random), b = uniform01(random), c = uniform01(random);
  const auto wrap = [](double u) { return u - std::floor(u); };
  std::vector<Vec3> x(radii.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = place(region,
                 {wrap(radical_inverse(i + 1, 2) + a), wrap(radical_inverse(i + 1, 3) + b),
                  wrap(radical_inverse(i + 1, 5) + c)},
                 radii[i]);
  return x;
}

}  // namespace

std::size_t spheres_of(const Body& body, const PackRequest& request) {
  const Region region(body, request.space);
  check(region, request);
  return by_sieves(request) ? number_by_sieves(region, request) : request.spheres;
}

Specimen pack_spheres(const Body& body, const PackRequest& request,
                      const std::function<void(double, double)>& progress) {
  const Region region(body, request.space);
  const std::size_t number = spheres_of(body, request);
  Random random(request.seed);
  auto radii = draw_radii(request.sizes, number, random, request.space);
  scale_to_porosity(region, request, radii);
  auto x = insert_evenly(region, radii, random);

  // Rows in the order of space: memory near, and ids that say nothing about size.
  const auto order = spatial_order(region, x, 2 * spacing(region, number));
  std::vector<double> r(x.size());
  std::vector<Vec3> centres(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) r[i] = radii[order[i]], centres[i] = x[order[i]];

  double mean_overlap = 0;
  const auto part = [&](double from, double share) {
    return [&progress, &mean_overlap, from, share](double done, double overlap) {
      mean_overlap = overlap;
      if (progress) progress(from + share * done, overlap);
    };
  };

  // First push apart, until the density is even; then weigh gaps as overlaps. A pull while spheres
  // still lie deep in each other, or in a packing looser than random close (0.36, where nothing
  // presses back), would clump them. The numbers of iterations are where coordination and overlaps
  // stop changing (1,000 to 70,000 spheres). Discs are not pulled: pushed alone they have the
  // coordination of the meshes of the Santasusana thesis (table 5.1), 5.1 at porosity 0.11 and 5.3
  // at 0.067 within 1.10 (ri + rj), and pulled they leave holes as large as a disc.
  constexpr double random_close = 0.36, dense = 0.26;
  const double cohesion =
      region.plane() ? 0.0 : std::clamp((random_close - request.porosity) / (random_close - dense), 0.0, 1.0);
  const RelaxStage apart{.iterations = 100}, even{.iterations = 200, .cohesion = cohesion};
  relax(region, apart, r, centres, part(0, 0.3));
  if (request.genesis_pressure > 0)
    inflate(region, request.genesis_pressure, r, centres, part(0.3, 0.7));
  else
    relax(region, even, r, centres, part(0.3, 0.7));
  check_fit(region, *std::max_element(r.begin(), r.end()), by_sieves(request));

  if (progress) progress(1, mean_overlap);

  Specimen specimen;
  specimen.source = "packed";
  specimen.spheres.resize(r.size());
  for (std::size_t i = 0; i < r.size(); ++i)
    specimen.spheres[i] = {.id = static_cast<Gid>(i + 1), .centre = centres[i], .radius = r[i]};
  return specimen;
}

}  // namespace breccia
