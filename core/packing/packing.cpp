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

// Below, overlaps beyond 20 % of ri + rj cannot be avoided.
constexpr double least_porosity_of(Space space) { return space == Space::two_d ? 0.02 : 0.15; }
constexpr double most_porosity = 0.60;
constexpr double most_genesis_pressure =
    0.12;  // overlaps to 20 %; beyond, linear springs let discs through walls

void check(const Region& region, const PackRequest& request) {
  if (region.plane() && region.body.shape == Shape::cylinder)
    fail<BadInput>("packing: a body in the plane is a box (rectangle) or a disc (circle), not a cylinder");
  const Vec3 edge = extent(region);
  for (const double length : {edge.x, edge.y, edge.z})
    if (!(std::isfinite(length) && length > 0))
      fail<BadInput>("packing: the body's dimensions {:g} x {:g} x {:g} m are not all positive", edge.x,
                     edge.y, edge.z);
  if (request.spheres == 0) fail<BadInput>("packing: 0 spheres asked for; at least 1 is needed");
  if (request.spheres > 100'000'000)
    fail<BadInput>("packing: {} spheres asked for; at most 100 million are possible", request.spheres);
  const double least_porosity = least_porosity_of(request.space);
  if (!(request.porosity >= least_porosity && request.porosity <= most_porosity))
    fail<BadInput>("packing: porosity {:g} is not between {:g} and {:g}", request.porosity, least_porosity,
                   most_porosity);
  if (!(request.genesis_pressure >= 0 && request.genesis_pressure <= most_genesis_pressure))
    fail<BadInput>("packing: genesis pressure {:g} k_n is not between 0 and {:g} k_n",
                   request.genesis_pressure, most_genesis_pressure);
  if (request.genesis_pressure > 0 && !region.plane())
    fail<BadInput>("packing: a genesis pressure is for discs in the plane, not for spheres");
  check_sizes(request.sizes);
}

void check_fit(const Region& region, double largest_radius) {
  const Vec3 edge = extent(region);
  if (const double most = region.plane() ? std::min(edge.x, edge.z) : std::min({edge.x, edge.y, edge.z});
      2 * largest_radius > most)
    fail<BadInput>(
        "packing: the largest sphere, {:g} m across, is bigger than the body, {:g} m at its narrowest: ask "
        "for more spheres",
        2 * largest_radius, most);
}

/// Scales the radii so that the sum of the spheres' volumes is (1 - porosity) of the body's.
void scale_to_porosity(const Region& region, double porosity, std::vector<double>& radii) {
  double powers = 0;
  for (const double r : radii) powers += region.plane() ? r * r : r * r * r;
  const double wanted = (1 - porosity) * volume(region) / volume_of(1, region.space);
  const double factor = region.plane() ? std::sqrt(wanted / powers) : std::cbrt(wanted / powers);
  for (double& r : radii) r *= factor;
  check_fit(region, radii.front());
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

/// Places the largest first along a randomly shifted Halton sequence: any run of it, so any range of sizes,
/// is spread evenly over the body. Independent random points would start with more in one end than in the
/// other by chance, and no relaxation carries that far.
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

Specimen pack_spheres(const Body& body, const PackRequest& request,
                      const std::function<void(double, double)>& progress) {
  const Region region(body, request.space);
  check(region, request);
  Random random(request.seed);
  auto radii = draw_radii(request.sizes, request.spheres, random, request.space);
  scale_to_porosity(region, request.porosity, radii);
  auto x = insert_evenly(region, radii, random);

  // Rows in the order of space: memory near, and ids that say nothing about size.
  const auto order = spatial_order(region, x, 2 * spacing(region, request.spheres));
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

  // First push apart, until the density is even; then weigh gaps as overlaps. A pull while spheres still lie
  // deep in each other, or in a packing looser than random close (0.36, where nothing presses back), would
  // clump them. The numbers of iterations are where coordination and overlaps stop changing (1,000 to 70,000
  // spheres). Discs are not pulled: pushed alone they have the coordination of the meshes of the Santasusana
  // thesis (table 5.1), 5.1 at porosity 0.11 and 5.3 at 0.067 within 1.10 (ri + rj), and pulled they leave
  // holes as large as a disc.
  constexpr double random_close = 0.36, dense = 0.26;
  const double cohesion =
      region.plane() ? 0.0 : std::clamp((random_close - request.porosity) / (random_close - dense), 0.0, 1.0);
  const RelaxStage apart{.iterations = 100}, even{.iterations = 200, .cohesion = cohesion};
  relax(region, apart, r, centres, part(0, 0.3));
  if (request.genesis_pressure > 0)
    inflate(region, request.genesis_pressure, r, centres, part(0.3, 0.7));
  else
    relax(region, even, r, centres, part(0.3, 0.7));
  check_fit(region, *std::max_element(r.begin(), r.end()));

  if (progress) progress(1, mean_overlap);

  Specimen specimen;
  specimen.source = "packed";
  specimen.spheres.resize(r.size());
  for (std::size_t i = 0; i < r.size(); ++i)
    specimen.spheres[i] = {.id = static_cast<Gid>(i + 1), .centre = centres[i], .radius = r[i]};
  return specimen;
}

}  // namespace breccia
