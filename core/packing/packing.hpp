// Dense random packings of spheres in cylinders, discs and boxes, and of discs in rectangles and circles.
#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "core/base/scene_options.hpp"
#include "core/geometry/specimen.hpp"

namespace breccia {

/// Size distribution of a packing made here.
struct SizeDistribution {
  enum class Kind { lognormal, uniform, sieves } kind = Kind::lognormal;
  /// lognormal: standard deviation of ln r, cut at 3 of them; uniform: half-width over mean
  double spread = 0.26;
  /// sieves: m, diameters, rising. Only their ratios count: sizes are scaled as a whole so that the number of
  /// spheres gives the porosity
  std::vector<double> sieve_openings;
  /// mass fraction passing each opening, rising from 0 to 1; straight over ln d in between
  std::vector<double> sieve_passing;
};

struct PackRequest {
  std::size_t spheres = 0;
  SizeDistribution sizes;
  double porosity = 0.26;  ///< 1 - sum of sphere volumes/body volume: overlaps count twice
  std::uint64_t seed = 1;
  Space space = Space::three_d;
  /// sigma_0/k_n that the walls feel when the discs press each other as linear springs; 0: not asked for. In
  /// the plane only; porosity is then where inflation starts
  double genesis_pressure = 0;
};

/// Packs spheres into a body whose centre is the origin and whose axis is z: dense, random, evenly filled up
/// to flat ends and mantle. Centres lie inside; overlaps reach 20 % of ri + rj, and spheres
/// stick out of walls by some 20 % of their radius at most. A bad request throws BadInput.
///
/// In the plane: discs 1 m thick, y = 0. A box is the rectangle of its width along x and its height along z,
/// a disc the circle of its diameter about y (its height is not read). With a genesis pressure the overlaps
/// are those of the pressed discs: bonds that take the distances as they are start free of stress.
/// @param request   number, sizes, porosity (0.15 to 0.60; in the plane 0.02 to 0.60), genesis pressure (to
/// 0.12) and
///                  seed; the same request gives the same packing bit for bit, with any number of threads
/// @param progress  called now and then with a fraction done and the present mean overlap/mean radius
Specimen pack_spheres(const Body& body, const PackRequest& request,
                      const std::function<void(double, double)>& progress = {});

}  // namespace breccia
