// A specimen as read from a file or packed: spheres, before any table is made of them.
#pragma once
#include <string>
#include <vector>

#include "core/tables/column.hpp"

namespace breccia {

struct SpecimenSphere {
  Gid id = 0;
  Vec3 centre;           ///< m
  double radius = 0;     ///< m
  int group = 1;         ///< cohesive group; 0 = bonds with nobody
  std::size_t line = 0;  ///< line of the file it was read from; 0 when packed
};

struct Specimen {
  std::vector<SpecimenSphere> spheres;
  std::string source;  ///< file name, or "packed"
};

enum class Shape { cylinder, disc, box };

/// The nominal body: areas and strains use it, not the spheres. Loaded along z.
struct Body {
  Shape shape = Shape::cylinder;
  double diameter = 0;   ///< m; cylinder, disc. A box: its width along x
  double depth = 0;      ///< m; a box: its width along y
  double height = 0;     ///< m, along the axis (disc: thickness)
  bool on_edge = false;  ///< a disc that stands: its axis is y, it is pressed across
  double hole = 0;       ///< m, diameter of a round hole along the axis; 0: none
};

}  // namespace breccia
