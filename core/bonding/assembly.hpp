// A specimen made ready: particles in their order, bonds between them, the layers that platens
// hold, the lateral surface. It is made once; every run of a series starts from a copy.
#pragma once
#include <algorithm>
#include <optional>
#include <vector>

#include "core/base/scene_options.hpp"
#include "core/geometry/specimen.hpp"
#include "core/tables/bond_table.hpp"
#include "core/tables/particle_table.hpp"

namespace breccia {

/// The two strips that press a disc. (B61)
struct Strips {
  bool planes = false;          ///< rigid planes that touch the disc, instead of layers of held spheres
  std::optional<double> width;  ///< m, across the load; nothing: 0.15 of the diameter
  std::optional<double> depth;  ///< m, from the rim, to which held spheres reach; nothing: 2.5 mean radii
};

struct BondingRule {
  double range = 0.10;                 ///< beta: bonded where |x_j - x_i| <= (1 + beta)(r_i + r_j)
  std::optional<double> coordination;  ///< instead: beta such that particles have this many bonds on average
  AreaRule area = AreaRule::minimum;
  std::optional<AreaRule> strength_area;  ///< of the strengths, where it is another one
  Space space = Space::three_d;
  Support grip = Support::ends;
  Strips strips{};
  std::vector<int> materials{};  ///< cohesive groups that have a material of their own
  bool across = false;           ///< spheres of different groups are bonded too
};

struct Assembly {
  Body body;
  Space space = Space::three_d;
  Support grip = Support::ends;
  bool rotation = true;  ///< particles turn
  ParticleTable particles;
  BondTable bonds;            ///< areas with alpha = 1; stiffness and damping not yet set
  std::size_t first_top = 0;  ///< rows [particles.free, first_top) lower layer, [first_top, size) upper layer
  std::vector<Row> lateral;   ///< particles at the lateral surface, rising rows
  std::vector<char> loose;    ///< per particle, 1 where it hangs on nothing; empty: not looked for
  double mean_radius = 0;     ///< m
  double layer = 0;           ///< m, thickness of the held layers or strips
  double strip_width = 0;     ///< m, of the strips that press a disc
  bool planes = false;        ///< planes press it, nothing is held
  double range = 0;           ///< beta that was used
  double coordination = 0;    ///< bonds per particle, both ends counted
  std::size_t dropped_bonds = 0;  ///< in range, but without an area (no common Voronoi face)
  std::size_t short_bonds = 0;    ///< nested spheres whose strains use a floor for their length

  bool cement = false;             ///< intact bonds pass moments
  double section() const;          ///< m^2, nominal, across the axis (of a disc on edge: its face)
  double lateral_surface() const;  ///< m^2, nominal
  double volume() const { return section() * body.height; }
  double length() const;        ///< m, between the ends that are pressed
  double load_section() const;  ///< m^2, by which a load becomes the stress that the test reports
};

/// Length of a bond that stiffness and strains refer to: the rest length, or 0.2 (r_i + r_j) for
/// nested spheres. (B8)
inline double strain_length_of(double rest_length, double radius_sum) {
  return std::max(rest_length, 0.2 * radius_sum);
}

/// True where a sphere reaches the nominal lateral surface to within 0.3 mean radii. (B63)
bool at_lateral_surface(const Body& body, Space space, const Vec3& centre, double radius, double mean_radius);

/// @param specimen  loaded along z, middle at the origin
/// @param features  those that run; columns are made for them
/// @param rotation  whether particles turn
/// @throws BadInput when nothing is bonded, or no sphere lies in an end layer
Assembly assemble(const Specimen& specimen, const Body& body, const BondingRule& rule,
                  const Features& features, int threads, bool rotation = true);

}  // namespace breccia
