// Where the surface of a specimen lies against its nominal body: what it is taken for, and what it
// is.
#pragma once
#include <optional>
#include <span>

#include "core/base/scene_options.hpp"
#include "core/geometry/specimen.hpp"
#include "kernels/math/strided.hpp"

namespace breccia {

/// How far spheres stay behind a nominal surface, in mean radii; negative: how far they reach
/// beyond it. Read from the outermost sphere of each patch of the surface, three mean radii wide.
/// Packings that were made against a wall have medians between -0.16 and 0.05, and next to no
/// roughness; one that was cut from a block has a roughness near 0.8.
struct SurfaceGap {
  double median = 0;
  double roughness = 0;  ///< from the first to the third quartile of the patches
};

enum class Fit { good, doubtful, wrong };

/// (B105): whether a body may be taken for its nominal one: a gap beyond what a rough surface
/// explains is wrong. The lateral surface is where spheres reach the nominal one to within 0.3 mean
/// radii: beyond that gap nothing is pressed.
Fit judge(const SurfaceGap& gap);
/// The same of an offset of the middle, in mean radii.
Fit judge_offset(double offset);

/// Median gap of a good packing, in mean radii: what a nominal size should leave.
inline constexpr double usual_gap = -0.08;

struct SurfaceFit {
  SurfaceGap across;                 ///< the round lateral surface, or the sides along x
  std::optional<SurfaceGap> depth;   ///< the sides along y of a box
  std::optional<SurfaceGap> height;  ///< both ends
  Vec3 offset;                       ///< of the middle of the spheres from that of the body, in mean radii
};

/// @param centre, radius  of the spheres that hang together, loaded along z, middle at the origin,
///         m
/// @param mean_radius     m, the measure
SurfaceFit fit_surface(const Body& body, Space space, std::span<const Vec3> centre,
                       std::span<const double> radius, double mean_radius);

}  // namespace breccia
