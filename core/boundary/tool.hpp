// A rigid tool that cuts into the top of a block: a wedge with a front face and a flank that meet
// in its tip. docs/model.md, "Cutting".
#pragma once
#include <cstdint>
#include <vector>

#include "core/bonding/assembly.hpp"
#include "core/ranks/partition.hpp"

namespace breccia {

/// What is asked of a tool. SI, angles in radians.
struct Cutting {
  double depth = 0;      ///< m, of the tip below the top of the block; 0: there is no tool
  double width = 0;      ///< m, across the way; 0: across the whole block
  double rake = 0;       ///< of the front face from the vertical; positive: it leans back
  double clearance = 0;  ///< of the flank from the horizontal
  double friction = 0;   ///< Coulomb, of the tool on spheres
};

/// It moves along x. It touches free spheres only, each at its point nearest to the centre, and
/// none of a block at rest.
struct Tool {
  bool enabled = false;
  Vec3 front, flank;  ///< unit, in the plane x-z: from the tip up its face, and back along its flank
  double tip_x = 0, tip_z = 0;  ///< m, when the run began
  double half_width = 0;        ///< m
  double area = 0;              ///< m^2, of the cut: depth times width
  double stiffness = 0;         ///< Pa: force over radius and depth
  double friction = 0;
  double speed = 0;             ///< m/s
  double travel = 0;            ///< m
  double work = 0;              ///< J, that it has done
  Vec3 load;                    ///< N, of the spheres on the tool in this step
  std::vector<Row> rows;        ///< free spheres that may touch before the list is made anew, rising
  std::vector<Vec3> force;      ///< N, on them in this step
  std::uint64_t next_list = 0;  ///< step at which the list is made anew
};

/// @param young_modulus  Pa, of the bonds
Tool make_tool(const Cutting& cutting, const Assembly& assembly, double young_modulus, double alpha);

/// The point of the tool nearest to a place that is not inside it, m; and from inside the nearest
/// of its front face, so that what has come in is pushed ahead.
struct NearestOnTool {
  Vec3 point;
  bool inside = false;
};
NearestOnTool nearest_on_tool(const Tool& tool, const Vec3& place);

/// Adds the tool's forces to the spheres (B119) and moves it on. Called on every rank.
void press_tool(Tool& tool, ParticleTable& particles, const Partition& partition, std::uint64_t step,
                double dt);

}  // namespace breccia
