// Dense random packings of spheres in cylinders, discs and boxes.
#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "core/specimen.hpp"

namespace breccia {

/// Size distribution of a packing made here.
struct SizeDistribution {
  enum class Kind { lognormal, uniform, sieves } kind = Kind::lognormal;
  double spread = 0.26;                 ///< lognormal: standard deviation of ln r; uniform: half-width over mean
  std::vector<double> sieve_openings;   ///< m, rising; sieves: diameters
  std::vector<double> sieve_passing;    ///< mass fraction passing each opening, rising to 1
};

struct PackRequest {
  std::size_t spheres = 0;
  SizeDistribution sizes;
  double porosity = 0.26;  ///< 1 - sum of sphere volumes/body volume: overlaps count twice
  std::uint64_t seed = 1;
};

/// Packs spheres into a body whose centre is the origin and whose axis is z.
/// @param request   number, sizes, porosity and seed; the same request gives the same packing
/// @param progress  called now and then with a fraction done and the present mean overlap/mean radius
Specimen pack_spheres(const Body& body, const PackRequest& request,
                      const std::function<void(double, double)>& progress = {});

}  // namespace breccia
