#include "core/packing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/packing_body.hpp"
#include "core/packing_neighbours.hpp"
#include "core/packing_relax.hpp"
#include "core/packing_sizes.hpp"

namespace breccia {
namespace {

using namespace packing;

constexpr double least_porosity = 0.15,
                 most_porosity = 0.60;  // below: overlaps beyond 20 % cannot be avoided

void check(const Body& body, const PackRequest& request) {
  const Vec3 edge = extent(body);
  for (const double length : {edge.x, edge.y, edge.z})
    if (!(std::isfinite(length) && length > 0))
      fail<BadInput>("packing: the body's dimensions {:g} x {:g} x {:g} m are not all positive", edge.x,
                     edge.y, edge.z);
  if (request.spheres == 0) fail<BadInput>("packing: 0 spheres asked for; at least 1 is needed");
  if (request.spheres > 100'000'000)
    fail<BadInput>("packing: {} spheres asked for; at most 100 million are possible", request.spheres);
  if (!(request.porosity >= least_porosity && request.porosity <= most_porosity))
    fail<BadInput>("packing: porosity {:g} is not between {:g} and {:g}", request.porosity, least_porosity,
                   most_porosity);
  check_sizes(request.sizes);
}

/// Scales the radii so that the sum of the spheres' volumes is (1 - porosity) of the body's.
void scale_to_porosity(const Body& body, double porosity, std::vector<double>& radii) {
  double cubes = 0;
  for (const double r : radii) cubes += r * r * r;
  const double wanted = (1 - porosity) * volume(body) / (4 * std::numbers::pi / 3);
  const double factor = std::cbrt(wanted / cubes);
  for (double& r : radii) r *= factor;
  const Vec3 edge = extent(body);
  if (const double most = std::min({edge.x, edge.y, edge.z}); 2 * radii.front() > most)
    fail<BadInput>(
        "packing: the largest sphere, {:g} m across, is bigger than the body, {:g} m at its narrowest: ask "
        "for more spheres",
        2 * radii.front(), most);
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
std::vector<Vec3> insert_evenly(const Body& body, const std::vector<double>& radii, Random& random) {
  const double a = uniform01(random), b = uniform01(random), c = uniform01(random);
  const auto wrap = [](double u) { return u - std::floor(u); };
  std::vector<Vec3> x(radii.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = place(body,
                 {wrap(radical_inverse(i + 1, 2) + a), wrap(radical_inverse(i + 1, 3) + b),
                  wrap(radical_inverse(i + 1, 5) + c)},
                 radii[i]);
  return x;
}

}  // namespace

Specimen pack_spheres(const Body& body, const PackRequest& request,
                      const std::function<void(double, double)>& progress) {
  check(body, request);
  Random random(request.seed);
  auto radii = draw_radii(request.sizes, request.spheres, random);
  scale_to_porosity(body, request.porosity, radii);
  auto x = insert_evenly(body, radii, random);

  // Rows in the order of space: memory near, and ids that say nothing about size.
  const double spacing = std::cbrt(volume(body) / static_cast<double>(request.spheres));
  const auto order = spatial_order(body, x, 2 * spacing);
  std::vector<double> r(x.size());
  std::vector<Vec3> centres(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) r[i] = radii[order[i]], centres[i] = x[order[i]];

  // First push apart, until the density is even; then weigh gaps as overlaps. A pull while spheres still lie
  // deep in each other, or in a packing looser than random close (0.36, where nothing presses back), would
  // clump them. The numbers of iterations are where coordination and overlaps stop changing (1,000 to 70,000
  // spheres).
  constexpr double random_close = 0.36, dense = 0.26;
  const double cohesion = std::clamp((random_close - request.porosity) / (random_close - dense), 0.0, 1.0);
  const RelaxStage apart{.iterations = 100, .cohesion = 0}, even{.iterations = 200, .cohesion = cohesion};
  double mean_overlap = 0;
  const auto part = [&](double from, double share) {
    return [&progress, &mean_overlap, from, share](double done, double overlap) {
      mean_overlap = overlap;
      if (progress) progress(from + share * done, overlap);
    };
  };
  relax(body, apart, r, centres, part(0, 0.3));
  relax(body, even, r, centres, part(0.3, 0.7));

  if (progress) progress(1, mean_overlap);

  Specimen specimen;
  specimen.source = "packed";
  specimen.spheres.resize(r.size());
  for (std::size_t i = 0; i < r.size(); ++i)
    specimen.spheres[i] = {.id = static_cast<Gid>(i + 1), .centre = centres[i], .radius = r[i]};
  return specimen;
}

}  // namespace breccia
