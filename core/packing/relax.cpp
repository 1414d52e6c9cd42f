#include "core/packing/relax.hpp"

#include <algorithm>

#include "core/base/threads.hpp"
#include "core/packing/neighbours.hpp"

namespace breccia::packing {
namespace {

// The forces. Unit: an overlap of 1 m pushes with 1 "newton", every sphere weighs 1 "kilogram".
//
// Labra & Onate, "High-density sphere packing for discrete element method simulations", Commun.
// Numer. Meth. Engng 25 (2009) 837-849 (GiD's manual names it as the method of its sphere mesher)
// reduce the sum of squared signed gaps between neighbours: gaps pull as overlaps push. That, and
// not a state of jamming, explains the wide bell of overlaps and gaps in such meshes. Overlaps
// alone (cohesion 0) leave at porosity 0.26 a sharp edge of touching pairs: coordination 9.1 within
// 1.10 (ri + rj), one overlap in a hundred above 0.10 of ri + rj. With the pull: 10.2, and one
// above 0.13; a real mesh of 13,500 spheres, lent for comparison: 10.65 and 0.16. They change the
// radii too; here radii follow a given law, and only centres move.

// The pull fades to nothing at this part of ri + rj; 0.20 leaves too few gaps.
constexpr double pull_range = 0.25;
// The same of a wall, of 2 r: it draws from farther, or the pull within would thin the packing near
// walls.
constexpr double wall_range = 1.0;
// Overlap, of ri + rj, where the push is twice the linear one; few go farther.
constexpr double stiff_overlap = 0.2;

double push(double overlap, double strain) {
  const double q = strain / stiff_overlap * (strain / stiff_overlap);
  return overlap * (1 + std::min(q * q, 30.0));  // bounded: spheres start deep in each other
}

/// On both spheres along their line, positive apart. 4 times the reduced radius is 2 r for equal
/// spheres; for unlike ones it is less than ri + rj, and keeps the small one from sinking into the
/// large one.
double pair_force(double overlap, double ri, double rj, double cohesion) {
  const double sum = ri + rj;
  if (overlap > 0) return push(overlap, overlap * sum / (4 * ri * rj));
  return cohesion * overlap * std::max(0.0, 1 + overlap / (pull_range * sum));
}

/// A wall is a mirror: the sphere meets its own image.
double wall_force(double distance, double r) {
  const double overlap = 2 * (r - distance);
  if (overlap > 0) return push(overlap, overlap / (2 * r));
  return overlap * std::max(0.0, 1 + overlap / (wall_range * 2 * r));
}

/// Fakhimi & Villegas (2007): no friction, no bond, one stiffness; unit k_n.
double linear_force(double overlap) { return std::max(overlap, 0.0); }

struct Sums {
  double power = 0, force2 = 0, speed2 = 0, overlap = 0;
  std::size_t overlaps = 0;
};

struct State {
  std::vector<Vec3> v, f;
  Neighbours near;
  std::vector<Vec3> x_listed;  // where the spheres were when neighbours were listed
};

constexpr double skin = 0.5;  // of the mean radius; 0.3 costs more, 0.8 as much

constexpr std::size_t block = 512;  // rows; sums are taken per block, then over blocks in order

template <class F>
void for_blocks(std::size_t rows, F&& f) {
  for_tasks((rows + block - 1) / block,
            [&](std::size_t b) { f(b, b * block, std::min(rows, (b + 1) * block)); });
}

double reach_of(const RelaxStage& stage) { return stage.cohesion > 0 ? 1 + pull_range : 1; }

Sums forces(const Region& region, const RelaxStage& stage, std::span<const double> r, std::span<const Vec3> x,
            State& s) {
  const double reach = reach_of(stage);
  std::vector<Sums> parts((x.size() + block - 1) / block);
  for_blocks(x.size(), [&](std::size_t b, std::size_t begin, std::size_t end) {
    Sums part;
    for (std::size_t i = begin; i < end; ++i) {
      Vec3 f;
      for (auto k = s.near.first[i]; k < s.near.first[i + 1]; ++k) {
        const auto j = s.near.other[k];
        const Vec3 d = x[i] - x[j];
        const double sum = r[i] + r[j], d2 = dot(d, d);
        if (d2 >= reach * sum * reach * sum || d2 == 0) continue;
        const double length = std::sqrt(d2), overlap = sum - length;
        const double force =
            stage.linear ? linear_force(overlap) : pair_force(overlap, r[i], r[j], stage.cohesion);
        f += (force / length) * d;
        if (overlap > 0) part.overlap += overlap, ++part.overlaps;
      }
      for_each_wall(region, x[i], [&](double distance, const Vec3& inward) {
        f += (stage.linear ? linear_force(r[i] - distance) : wall_force(distance, r[i])) * inward;
      });
      s.f[i] = f;
      part.power += dot(f, s.v[i]);
      part.force2 += dot(f, f);
      part.speed2 += dot(s.v[i], s.v[i]);
    }
    parts[b] = part;
  });
  Sums all;
  for (const Sums& p : parts) {
    all.power += p.power, all.force2 += p.force2, all.speed2 += p.speed2;
    all.overlap += p.overlap, all.overlaps += p.overlaps;
  }
  return all;
}

// FIRE: Bitzek, Koskinen, Gaehler, Moseler & Gumbsch, Phys. Rev. Lett. 97 (2006) 170201, with their
// constants.
struct Fire {
  static constexpr double dt_start = 0.1, dt_most = 0.6, mix_start = 0.1;
  double dt = dt_start, mix = mix_start;
  int downhill = 0;
  double keep = 0, steer = 0;  // v <- keep v + steer f

  void adapt(const Sums& s) {
    if (s.power > 0) {
      keep = 1 - mix, steer = mix * std::sqrt(s.speed2 / s.force2);
      if (++downhill > 5) dt = std::min(1.1 * dt, dt_most), mix *= 0.99;
    } else {
      keep = steer = 0, downhill = 0, dt *= 0.5, mix = mix_start;
    }
    dt = std::max(dt, 0.01);
  }
};

/// @param margin  of a centre to the walls at least, of its radius
/// @return the largest distance any sphere has come since neighbours were listed, m
double move(const Region& region, const Fire& fire, double margin, std::span<const double> r,
            std::span<Vec3> x, State& s) {
  std::vector<double> parts((x.size() + block - 1) / block);
  for_blocks(x.size(), [&](std::size_t b, std::size_t begin, std::size_t end) {
    double most2 = 0;
    for (std::size_t i = begin; i < end; ++i) {
      s.v[i] = fire.keep * s.v[i] + (fire.steer + fire.dt) * s.f[i];
      Vec3 step = fire.dt * s.v[i];
      const double length = norm(step), limit = 0.2 * r[i];
      if (length > limit) step = (limit / length) * step;
      x[i] = keep_inside(region, x[i] + step, margin * r[i]);
      const Vec3 moved = x[i] - s.x_listed[i];
      most2 = std::max(most2, dot(moved, moved));
    }
    parts[b] = most2;
  });
  return std::sqrt(*std::max_element(parts.begin(), parts.end()));
}

}  // namespace

bool relax(const Region& region, const RelaxStage& stage, std::span<const double> r, std::span<Vec3> x,
           const std::function<void(double, double)>& progress) {
  double mean_radius = 0;
  for (const double each : r) mean_radius += each / static_cast<double>(r.size());

  // A linear spring lets a disc in a tight place far into a wall: 0.5 would hold it there, out of
  // balance
  const double margin = stage.linear ? 0.1 : 0.5;
  State s{std::vector<Vec3>(x.size()), std::vector<Vec3>(x.size()), {}, {}};
  Fire fire;
  double moved = 0;
  for (int k = 0; k < stage.iterations; ++k) {
    if (k == 0 || 2 * moved > skin * mean_radius) {
      s.near = find_neighbours(region, x, r, reach_of(stage), skin * mean_radius);
      s.x_listed.assign(x.begin(), x.end());
    }
    const Sums sums = forces(region, stage, r, x, s);
    const double mean_overlap = sums.overlaps ? sums.overlap / static_cast<double>(sums.overlaps) : 0.0;
    if (progress && k % 10 == 0)
      progress(static_cast<double>(k) / stage.iterations, mean_overlap / mean_radius);
    if (sums.force2 == 0) return true;  // loose: nobody touches anybody
    if (std::sqrt(sums.force2 / static_cast<double>(x.size())) < stage.balance * mean_overlap) return true;
    fire.adapt(sums);
    moved = move(region, fire, margin, r, x, s);
  }
  return false;
}

}  // namespace breccia::packing
