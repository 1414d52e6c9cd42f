// How the two ends of a bond or contact move against each other. MODEL section 4; Onate et al. 2015, eqs.
// 24-27.
#pragma once
#include "kernels/lanes.hpp"

namespace breccia {

/// One end of a bond: where it is and how it moves. x at step n, v and w half a step before.
template <class R>
struct End {
  Vec<R> x;  ///< m
  Vec<R> v;  ///< m/s
  Vec<R> w;  ///< 1/s
  R radius;  ///< m
};

/// The pair seen from `lo`: every difference is hi minus lo.
template <class R>
struct Pair {
  R distance;            ///< m, between the centres
  Vec<R> normal;         ///< from lo to hi
  Vec<R> normal_before;  ///< one step ago
  R rate;                ///< m/s, of elongation
  Vec<R> slip;           ///< m, tangential displacement of this step
  R twist;               ///< rad, mean turn of both ends about the normal in this step
  R arm_ratio;           ///< d/(r_lo + r_hi): arms are radius * arm_ratio, their sum is the distance
};

/// @param rotation  false: spins are taken as zero and cost nothing
template <bool rotation, class R>
inline Pair<R> relative_motion(const End<R>& lo, const End<R>& hi, double dt) {
  const Vec<R> l = hi.x - lo.x;
  const Vec<R> dv = hi.v - lo.v;
  const R step = dt;
  Pair<R> p;
  p.distance = square_root(dot(l, l));
  p.normal = (R(1.0) / p.distance) * l;
  const Vec<R> before = l - step * dv;
  p.normal_before = (R(1.0) / square_root(dot(before, before))) * before;
  p.rate = dot(dv, p.normal);
  p.arm_ratio = p.distance / (lo.radius + hi.radius);
  Vec<R> at_contact = dv - p.rate * p.normal;
  if constexpr (rotation) {
    // arms times spins, as mean and difference of the ends: the same bits whichever end comes first, also
    // where the compiler fuses a product with a sum
    const Vec<R> both = lo.w + hi.w;
    const R half(0.5);
    const Vec<R> spins =
        (half * p.distance) * both + (half * p.arm_ratio * (lo.radius - hi.radius)) * (lo.w - hi.w);
    at_contact -= cross(spins, p.normal);
    p.twist = R(0.5 * dt) * dot(both, p.normal);
  }
  p.slip = step * at_contact;
  return p;
}

/// Carries a tangential vector along with the pair: the turn of the normal, then the mean twist about it.
/// Its length does not change.
template <bool rotation, class R>
inline Vec<R> carry(const Vec<R>& f, const Pair<R>& p) {
  const R along = dot(f, p.normal) / (R(1.0) + dot(p.normal_before, p.normal));
  Vec<R> turned = f - along * (p.normal_before + p.normal);
  if constexpr (rotation) {
    // tan(twist/2) to fifth order; cosine and sine below are of one angle, so the length stays
    const R half = R(0.5) * p.twist;
    const R t = half + R(1.0 / 3.0) * half * half * half;
    const R s = R(1.0) / (R(1.0) + t * t);
    turned = ((R(1.0) - t * t) * s) * turned + (R(2.0) * t * s) * cross(p.normal, turned);
  }
  return turned;
}

}  // namespace breccia
