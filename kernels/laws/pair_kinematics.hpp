// How the two ends of a bond or contact move against each other: docs/model.md, "Pairs"; Onate et
// al. 2015, eqs. 24-27 and 34.
#pragma once
#include "kernels/math/lanes.hpp"

namespace breccia {

/// One end of a bond: where it is and how it moves. x at step n, v and w half a step before.
template <class R>
struct End {
  Vec<R> x;  ///< m
  Vec<R> v;  ///< m/s
  Vec<R> w;  ///< 1/s
};

/// Both ends as their differences, hi minus lo, which is all that matters.
template <class R>
struct Ends {
  Vec<R> branch;           ///< m, x_hi - x_lo
  Vec<R> velocity;         ///< m/s, v_hi - v_lo
  Vec<R> spin_sum;         ///< 1/s, w_lo + w_hi
  Vec<R> spin_difference;  ///< 1/s, w_lo - w_hi
};

template <class R>
inline Ends<R> ends_of(const End<R>& lo, const End<R>& hi) {
  return {hi.x - lo.x, hi.v - lo.v, lo.w + hi.w, lo.w - hi.w};
}

/// The pair seen from `lo`: every difference is hi minus lo.
template <class R>
struct Pair {
  R distance;            ///< m, between the centres
  Vec<R> normal;         ///< from lo to hi
  Vec<R> normal_before;  ///< one step ago
  R turn_cosine;         ///< of the angle between the two
  R rate;                ///< m/s, of elongation
  R stretching;          ///< m, elongation of this step, to first order
  Vec<R> slip;           ///< m, tangential displacement of this step
  R twist;               ///< rad, mean turn of both ends about the normal in this step
};

/// @param rotation   false: spins are taken as zero and cost nothing
/// @param arm_offset  of the distance, 1/2 + this is the arm of lo, 1/2 - this that of hi
template <bool rotation, class R>
inline Pair<R> relative_motion(const Ends<R>& ends, const R& arm_offset, double dt) {
  const Vec<R>&l = ends.branch, &dv = ends.velocity;
  const R step = dt;
  Pair<R> p;
  // a step turns and stretches a pair little, so the distance before it, d0, needs neither root nor
  // division: d/d0 is a short series. Products that do not wait for each other come first
  const Vec<R> before = l - step * dv;  // (B4)
  const R square = dot(l, l), per_square = R(1.0) / square;
  p.distance = square_root(square);
  const R per_distance = p.distance * per_square;
  const R shrunk = inverse_root_near_one(dot(before, before) * per_square);
  p.normal = per_distance * l;
  p.normal_before = (per_distance * shrunk) * before;
  p.turn_cosine = dot(before, l) * per_square * shrunk;
  p.rate = dot(dv, p.normal);  // (P26)
  p.stretching = step * p.rate;
  Vec<R> at_contact = dv - p.rate * p.normal;
  if constexpr (rotation) {
    // arms times spins, as mean and difference of the ends: the same bits whichever end comes
    // first, also where the compiler fuses a product with a sum
    at_contact -= cross(R(0.5) * ends.spin_sum + arm_offset * ends.spin_difference, l);  // (B3)
    p.twist = R(0.5 * dt) * dot(ends.spin_sum, p.normal);
  }
  p.slip = step * at_contact;  // (P34)
  return p;
}

/// (B6): m, by which the pair became longer in this step: (d^2 - d0^2)/(d + d0), without the
/// difference of two large numbers.
template <class R>
inline R elongation(const Ends<R>& ends, const Pair<R>& p, double dt) {
  const Vec<R> moved = R(dt) * ends.velocity, before = ends.branch - moved;
  return dot(moved, ends.branch + before) / (p.distance + dot(before, p.normal_before));
}

/// Carries a tangential vector along with the pair: the turn of the normal, then the mean twist
/// about it. Its length does not change. (B5)
template <bool rotation, class R>
inline Vec<R> rotate_with_pair(const Vec<R>& f, const Pair<R>& p) {
  const R along = R(0.5) * dot(f, p.normal) * inverse_near_one(R(0.5) + R(0.5) * p.turn_cosine);
  Vec<R> turned = f - along * (p.normal_before + p.normal);
  if constexpr (rotation) {
    // tan(twist/2) to fifth order; cosine and sine below are of one angle, so the length stays
    const R half = R(0.5) * p.twist, half2 = half * half;
    const R t = half + R(1.0 / 3.0) * half * half2, t2 = t * t;
    const R s = inverse_near_one(R(1.0) + t2);
    turned = ((R(1.0) - t2) * s) * turned + (R(2.0) * t * s) * cross(p.normal, turned);
  }
  return turned;
}

}  // namespace breccia
