// Compiled once per instruction set (BRECCIA_ISA names it), each in a namespace of its own, so that no
// function built for wide registers can be linked into code that runs without them.
#include "kernels/bond_pass.hpp"

#include <algorithm>

#include "kernels/bond_force.hpp"
#include "kernels/kernel_list.hpp"
#include "kernels/lane_rows.hpp"
#include "kernels/scatter_block.hpp"

namespace breccia::BRECCIA_ISA {
namespace {

constexpr std::size_t ahead = 32;  // bonds, some 400 ns
constexpr std::size_t stride = sizeof(BondLoad) / sizeof(Vec3);
static_assert(bond_batch % width == 0 && LoadBlock::capacity % bond_batch == 0);

Lanes load(const double* p) { return Lanes(p, std::experimental::element_aligned); }
void store(const Lanes& r, double* p) { r.copy_to(p, std::experimental::element_aligned); }

/// Rows are subtracted before they are turned into columns: four turns instead of six.
template <Features features>
[[gnu::always_inline]] inline Ends<Lanes> ends_of_batch(const BondPassIn& in, std::size_t b) {
  const Index *lo = in.row_lo.data() + b, *hi = in.row_hi.data() + b;
  const Vec3 *x = in.position.data(), *v = in.velocity.data(), *w = in.spin.data();
  Ends<Lanes> ends;
  ends.branch = columns_of([&](std::size_t k) { return four(x[hi[k]]) - four(x[lo[k]]); });
  ends.velocity = columns_of([&](std::size_t k) { return four(v[hi[k]]) - four(v[lo[k]]); });
  if constexpr (features.rotation) {
    ends.spin_sum = columns_of([&](std::size_t k) { return four(w[lo[k]]) + four(w[hi[k]]); });
    ends.spin_difference = columns_of([&](std::size_t k) { return four(w[lo[k]]) - four(w[hi[k]]); });
  }
  return ends;
}

/// Asks for the rows of the far ends of a later batch: the stream of bonds pushes particles out of the near
/// caches, and the processor cannot guess which come next. Bonds are sorted by their lower row, so the other
/// end has just been used.
template <Features features>
[[gnu::always_inline]] inline void prefetch_ends(const BondPassIn& in, const Scatter& to, std::size_t b) {
  for (std::size_t k = b; k < b + width; ++k) {
    const Index row = std::max(in.row_lo[k], in.row_hi[k]);
    __builtin_prefetch(&in.position[row]);
    __builtin_prefetch(&in.velocity[row]);
    if constexpr (features.rotation) __builtin_prefetch(&in.spin[row]);
  }
  if (to.mode != ScatterMode::own) return;
  for (std::size_t k = b; k < b + width; ++k) {
    const Index row = std::max(to.to_lo[k], to.to_hi[k]);
    __builtin_prefetch(&to.force[row], 1);
    if constexpr (features.rotation) __builtin_prefetch(&to.torque[row], 1);
  }
}

/// Which lanes of a batch broke in this step goes into the notes; rare, so out of the loop's way.
template <Features features>
[[gnu::noinline]] void note_breaks(const BondPassHistory& now, const BondHistory<Lanes>& before,
                                   std::size_t b, BreakNotes& notes) {
  for (std::size_t k = 0; k < width; ++k) {
    const bool was = before.damage_normal[k] >= 1.0 || before.damage_shear[k] >= 1.0;
    const bool is = now.damage_normal[b + k] >= 1.0 || now.damage_shear[b + k] >= 1.0;
    if (was || !is) continue;
    if (notes.count < notes.room.size())
      notes.room[notes.count] = {static_cast<Index>(b + k),
                                 {before.shear.x[k], before.shear.y[k], before.shear.z[k]},
                                 features.plasticity ? static_cast<double>(before.plastic_stretch[k]) : 0.0,
                                 before.damage_normal[k],
                                 before.damage_shear[k]};
    ++notes.count;
  }
}

/// Flattened: with several laws in one file the compiler stops inlining a law into its loop by itself, and
/// wide registers then travel through memory (19 ns a bond instead of 13).
template <class Law, Features features>
[[gnu::flatten]] void bond_pass(const BondPassIn& in, const BondPassHistory& history, std::size_t first,
                                std::size_t last, const Scatter& to, BreakNotes* notes) {
  const Law& law = *static_cast<const Law*>(in.law);
  LoadBlock block;
  while (first < last) {
    const std::size_t count = last - first < LoadBlock::capacity ? last - first : LoadBlock::capacity;
    for (std::size_t k = 0; k < count; k += width) {
      const std::size_t b = first + k;
      if (b + ahead < in.row_lo.size()) prefetch_ends<features>(in, to, b + ahead);
      Lanes arm_offset(0.0);
      if constexpr (features.rotation) arm_offset = load(in.arm_offset.data() + b);
      const Pair<Lanes> pair =
          relative_motion<features.rotation>(ends_of_batch<features>(in, b), arm_offset, in.dt);
      BondConstants<Lanes> bond{load(in.rest_length.data() + b), load(in.area.data() + b),
                                load(in.strength_area.data() + b), load(in.stiffness.data() + b), Lanes(0.0)};
      if constexpr (features.contact_damping) bond.damping = load(in.damping.data() + b);
      BondHistory<Lanes> h;
      h.shear = {load(history.shear_x.data() + b), load(history.shear_y.data() + b),
                 load(history.shear_z.data() + b)};
      if constexpr (features.plasticity) h.plastic_stretch = load(history.plastic_stretch.data() + b);
      if constexpr (features.breakage) {
        h.damage_normal = load(history.damage_normal.data() + b);
        h.damage_shear = load(history.damage_shear.data() + b);
      }

      const BondHistory<Lanes> before = h;
      const Vec<Lanes> force = bond_force<features>(law, bond, pair, h);

      store(h.shear.x, history.shear_x.data() + b);
      store(h.shear.y, history.shear_y.data() + b);
      store(h.shear.z, history.shear_z.data() + b);
      // most batches neither yield nor break in a step: what stays is not written
      if constexpr (features.plasticity)
        if (any(h.plastic_stretch != before.plastic_stretch))
          store(h.plastic_stretch, history.plastic_stretch.data() + b);
      if constexpr (features.breakage)
        if (any(h.damage_normal != before.damage_normal || h.damage_shear != before.damage_shear)) {
          store(h.damage_normal, history.damage_normal.data() + b);
          store(h.damage_shear, history.damage_shear.data() + b);
          if (notes) note_breaks<features>(history, before, b, *notes);
        }
      store_rows(force, &block.load[k].force, stride);
      if constexpr (features.rotation)
        store_rows(pair.distance * cross(pair.normal, force), &block.load[k].moment, stride);
    }
    scatter_block(to, block, first, count);
    first += count;
  }
}

template <std::size_t... k>
constexpr std::array<BondPass, sizeof...(k)> all_passes(std::index_sequence<k...>) {
  return {bond_pass<LawOfKernel<k>, kernel_list[k].features>...};
}

}  // namespace

extern const std::array<BondPass, kernel_list.size()> passes;
const std::array<BondPass, kernel_list.size()> passes =
    all_passes(std::make_index_sequence<kernel_list.size()>{});

}  // namespace breccia::BRECCIA_ISA
