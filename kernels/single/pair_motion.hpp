// How a pair of bonded particles moves in a step, from differences of integers: pure functions over
// a number type R, a register of floats in the loop. docs/model.md, "Single precision".
#pragma once
#include "kernels/math/lanes.hpp"

namespace breccia {

/// Quanta of length that a unit of the anchor stands for.
inline constexpr int coarse_parts = 512;

/// What a pair's records say: differences of rows, but of the third the sums.
template <class R>
struct EndColumns {
  Vec<R> place, moved, spun, anchor;
};

template <class R>
struct PairMotion {
  Vec<R> branch, moved, spun;  ///< quanta of length; of motion
  R finer;                     ///< quanta of length in one of motion
  R per_radii;                 ///< 1/(r_lo + r_hi)
  R per_square, per_distance;  ///< 1/d^2, 1/d
  R longer;                    ///< than between the anchors
  R anchor_distance;           ///< between the anchors
  R along;                     ///< moved . branch
  R rate;                      ///< of elongation, quanta a step
};

/// (B127): |l| - |l0| = (l + l0).(l - l0)/(|l| + |l0|): without the difference of two large
/// numbers.
template <class R>
[[gnu::always_inline]] inline PairMotion<R> motion_of(const EndColumns<R>& ends, const R& per_radii,
                                                      const R& finer) {
  const R coarse(coarse_parts);
  PairMotion<R> m;
  m.finer = finer;
  const Vec<R> anchors = coarse * ends.anchor;
  m.branch = anchors + ends.place;
  m.moved = ends.moved, m.spun = ends.spun;
  m.per_radii = per_radii;
  const R square = dot(m.branch, m.branch);
  const R growth = dot(anchors + m.branch, ends.place);
  const R distance = square_root(square);
  m.anchor_distance = square_root(square - growth);
  m.per_square = R(1.0) / square;
  m.per_distance = distance * m.per_square;
  m.longer = growth / (distance + m.anchor_distance);
  m.along = dot(m.moved, m.branch);
  m.rate = finer * m.per_distance * m.along;
  return m;
}

/// The history of shear, carried along with the pair and with this step's k_s du: the turn of the
/// normal, the twist about it and the slip in one expression without the normal (B128).
template <bool rotation, class R>
[[gnu::always_inline]] inline Vec<R> trial_shear(const PairMotion<R>& m, const Vec<R>& f, const R& k_s) {
  const R half(0.5);
  const R out_of_plane = dot(f, m.branch) * m.per_square, stretch = m.along * m.per_square;
  const R g = m.finer * (k_s + half * out_of_plane), h = g * stretch + out_of_plane;
  Vec<R> trial = f + g * m.moved - h * m.branch;
  if constexpr (rotation) {
    const R per_fine = m.finer * m.per_radii, twist = per_fine * dot(m.spun, m.branch);
    const R turn = twist * m.per_square;
    trial += cross(m.branch, turn * f + (k_s * per_fine) * m.spun) - (half * twist * turn) * f;
  }
  return trial;
}

/// This step's, quanta of length.
template <bool rotation, class R>
[[gnu::always_inline]] inline Vec<R> slip_of(const PairMotion<R>& m) {
  Vec<R> slip = m.moved - (m.along * m.per_square) * m.branch;
  if constexpr (rotation) slip += m.per_radii * cross(m.branch, m.spun);
  return m.finer * slip;
}

/// (B6): of this step, quanta of length, to second order.
template <class R>
[[gnu::always_inline]] inline R elongation_of(const PairMotion<R>& m) {
  const R across = (m.finer * m.finer) * dot(m.moved, m.moved) - m.rate * m.rate;
  return m.rate - R(0.5) * m.per_distance * across;
}

/// What acts on an end in all: along the branch and across it.
template <class R>
[[gnu::always_inline]] inline Vec<R> force_of(const PairMotion<R>& m, const R& along, const Vec<R>& shear) {
  return (along * m.per_distance) * m.branch + shear;
}

/// Its moment about either end over the radius there.
template <class R>
[[gnu::always_inline]] inline Vec<R> moment_of(const PairMotion<R>& m, const Vec<R>& shear) {
  return cross(m.per_radii * m.branch, shear);
}

}  // namespace breccia
