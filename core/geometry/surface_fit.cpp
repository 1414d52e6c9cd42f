#include "core/geometry/surface_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace breccia {
namespace {

using std::numbers::pi;

/// A sphere as a surface sees it: where it lies along the surface, and how far it reaches out.
struct Seen {
  double u, v, reach;
};

/// A surface unrolled.
struct Sheet {
  double low_u, high_u, low_v, high_v;  ///< m
  double outside;                       ///< m, of the nominal surface from the middle
  bool round_end = false;               ///< only patches with their middle within 0.9 of the radius count
};

struct Patch {
  double u, v, gap;  ///< m; gap infinite where no sphere lies below the patch
};

/// Patches some three mean radii wide, fewer where spheres are few: four to each on average.
std::vector<Patch> patches_of(const Sheet& s, std::span<const Seen> seen, double mean_radius) {
  const double u = s.high_u - s.low_u, v = s.high_v - s.low_v;
  const double most = std::max(1.0, 0.25 * static_cast<double>(seen.size()));
  const double side =
      v > 0.0 ? std::max(3.0 * mean_radius, std::sqrt(u * v / most)) : std::max(3.0 * mean_radius, u / most);
  const auto count = [&](double length) { return std::max(1, static_cast<int>(length / side)); };
  const int n = count(u), m = v > 0.0 ? count(v) : 1;
  const auto at = [](double x, double low, double length, int parts) {
    if (!(length > 0.0)) return 0;
    return static_cast<int>(std::clamp((x - low) / length * parts, 0.0, parts - 1.0));
  };
  std::vector<double> reach(static_cast<std::size_t>(n * m), -std::numeric_limits<double>::infinity());
  for (const Seen& sphere : seen) {
    double& most_out =
        reach[static_cast<std::size_t>(at(sphere.u, s.low_u, u, n) * m + at(sphere.v, s.low_v, v, m))];
    most_out = std::max(most_out, sphere.reach);
  }
  std::vector<Patch> patches;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const double x = s.low_u + (i + 0.5) / n * u, y = s.low_v + (j + 0.5) / m * v;
      if (s.round_end && n > 1 && std::hypot(x, y) > 0.9 * s.high_u) continue;
      patches.push_back({x, y, s.outside - reach[static_cast<std::size_t>(i * m + j)]});
    }
  return patches;
}

SurfaceGap gap_of(std::vector<double> gaps, double mean_radius) {
  std::sort(gaps.begin(), gaps.end());
  const std::size_t last = gaps.size() - 1;
  return {gaps[last / 2] / mean_radius, (gaps[last * 3 / 4] - gaps[last / 4]) / mean_radius};
}

std::vector<double> gaps_of(std::span<const Patch> patches) {
  std::vector<double> gaps;
  for (const Patch& p : patches) gaps.push_back(p.gap);
  return gaps;
}

SurfaceGap mean_of(const SurfaceGap& a, const SurfaceGap& b) {
  return {0.5 * (a.median + b.median), std::max(a.roughness, b.roughness)};
}

struct Fitter {
  const Body& body;
  std::span<const Vec3> centre;
  std::span<const double> radius;
  double mean_radius;

  template <class See>
  std::vector<Seen> all(const See& see) const {
    std::vector<Seen> seen(centre.size());
    for (std::size_t k = 0; k < centre.size(); ++k) seen[k] = see(centre[k], radius[k]);
    return seen;
  }

  /// Two faces opposite each other, along one coordinate. @returns the middle of both medians; the
  /// offset is half of their difference
  SurfaceGap faces(double Vec3::*along, double Vec3::*u, double width_u, double Vec3::*v, double width_v,
                   double outside, bool round_end, double& offset) const {
    SurfaceGap side[2];
    for (const int k : {0, 1}) {
      const double sign = k == 0 ? -1.0 : 1.0;
      const std::vector<Seen> seen = all([&](const Vec3& x, double r) {
        return Seen{x.*u, v ? x.*v : 0.0, sign * (x.*along) + r};
      });
      const Sheet sheet{-0.5 * width_u, 0.5 * width_u, -0.5 * width_v, 0.5 * width_v, outside, round_end};
      side[k] = gap_of(gaps_of(patches_of(sheet, seen, mean_radius)), mean_radius);
    }
    offset = 0.5 * (side[0].median - side[1].median);
    return mean_of(side[0], side[1]);
  }

  /// A circle about the axis, unrolled, as long as the body or a line. The middle is moved until
  /// the gaps are the same all around.
  SurfaceGap round(double Vec3::*y, double Vec3::*along, double length, Vec3& offset) const {
    const double nominal = 0.5 * body.diameter;
    double at_x = 0.0, at_y = 0.0;  // m, of the middle
    std::vector<double> gaps;
    constexpr int most_turns = 12;
    for (int turn = 0; turn < most_turns; ++turn) {
      const std::vector<Seen> seen = all([&](const Vec3& p, double r) {
        const double dx = p.x - at_x, dy = p.*y - at_y;
        return Seen{nominal * std::atan2(dy, dx), along ? p.*along : 0.0, std::hypot(dx, dy) + r};
      });
      const Sheet sheet{-pi * nominal, pi * nominal, -0.5 * length, 0.5 * length, nominal};
      const std::vector<Patch> patches = patches_of(sheet, seen, mean_radius);
      gaps = gaps_of(patches);
      const double median = gap_of(gaps, 1.0).median;
      double sum_x = 0.0, sum_y = 0.0;
      for (const Patch& p : patches) {
        // a notch, or a patch without a sphere, is no sign of an offset
        const double gap = std::clamp(p.gap, median - mean_radius, median + mean_radius);
        sum_x -= gap * std::cos(p.u / nominal), sum_y -= gap * std::sin(p.u / nominal);
      }
      const double part = 2.0 / static_cast<double>(patches.size());
      const bool turns_around = patches.size() >= 3 && 2.0 * pi * nominal > 9.0 * mean_radius;
      if (!turns_around || std::hypot(part * sum_x, part * sum_y) < 0.01 * mean_radius) break;
      at_x += part * sum_x, at_y += part * sum_y;
    }
    offset.x = at_x / mean_radius;
    offset.*y = at_y / mean_radius;
    return gap_of(std::move(gaps), mean_radius);
  }
};

}  // namespace

Fit judge(const SurfaceGap& gap) {
  // a surface that was cut from a block reaches beyond its nominal place here, and stays behind it
  // there
  const double roughness = std::isfinite(gap.roughness) ? gap.roughness : 0.0;
  if (!(gap.median <= 0.3) || gap.median < -0.4 - 0.75 * roughness) return Fit::wrong;
  return gap.median > 0.15 || gap.median < -0.25 ? Fit::doubtful : Fit::good;
}

Fit judge_offset(double offset) {
  const double size = std::abs(offset);
  return size > 0.4 ? Fit::wrong : size > 0.2 ? Fit::doubtful : Fit::good;
}

SurfaceFit fit_surface(const Body& body, Space space, std::span<const Vec3> centre,
                       std::span<const double> radius, double mean_radius) {
  const Fitter f{body, centre, radius, mean_radius};
  const bool plane = space == Space::two_d, box = body.shape == Shape::box;
  const double width = body.diameter, height = body.height;
  SurfaceFit fit;
  if (plane && !box) {
    fit.across = f.round(&Vec3::z, nullptr, 0.0, fit.offset);
    return fit;
  }
  if (plane) {
    fit.across = f.faces(&Vec3::x, &Vec3::z, height, nullptr, 0.0, 0.5 * width, false, fit.offset.x);
    fit.height = f.faces(&Vec3::z, &Vec3::x, width, nullptr, 0.0, 0.5 * height, false, fit.offset.z);
    return fit;
  }
  if (box) {
    fit.across = f.faces(&Vec3::x, &Vec3::y, body.depth, &Vec3::z, height, 0.5 * width, false, fit.offset.x);
    fit.depth = f.faces(&Vec3::y, &Vec3::x, width, &Vec3::z, height, 0.5 * body.depth, false, fit.offset.y);
  } else {
    fit.across = f.round(&Vec3::y, &Vec3::z, height, fit.offset);
  }
  fit.height = f.faces(&Vec3::z, &Vec3::x, width, &Vec3::y, box ? body.depth : width, 0.5 * height, !box,
                       fit.offset.z);
  return fit;
}

}  // namespace breccia
