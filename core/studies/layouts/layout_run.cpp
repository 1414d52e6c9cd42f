#include "core/studies/layouts/layout_run.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "core/base/threads.hpp"
#include "core/world/loop_views.hpp"
#include "core/world/single_precision.hpp"
#include "core/world/sync.hpp"

namespace breccia {
namespace {

ScatterKind kind_of(Summation sums) {
  switch (sums) {
    case Summation::gather:
      return ScatterKind::gather;
    case Summation::shared_atomic:
    case Summation::all_atomic:
      return ScatterKind::atomic;
    case Summation::private_sums:
    case Summation::colours:
      break;
  }
  return ScatterKind::private_sums;
}

}  // namespace

LayoutRun::LayoutRun(const World& scene, const Layout& layout, int threads)
    : layout_(layout), threads_(threads), world_(scene), scene_bonds_(scene.bonds.size) {
  ParticleTable& p = world_.particles;
  BondTable& b = world_.bonds;
  world_.options.threads = threads;
  if (layout.sums == Summation::colours) {
    ColouredBonds coloured = colour_bonds(b, p.size);
    b = std::move(coloured.bonds);
    first_of_colour_ = std::move(coloured.first);
    source_ = std::move(coloured.source);
  }
  // the ranges of a colour are its own; with one range nothing is planned
  const int ranges = layout.sums == Summation::colours ? 1 : threads;
  const std::size_t batch = in_single() ? std::size_t{ForceBuffer::capacity} : bond_batch;
  world_.bond_plan =
      plan_scatter(kind_of(layout.sums), ranges, batch, b.row_lo, b.row_hi, std::span(b.gid_lo).first(b.size),
                   std::span(b.gid_hi).first(b.size), b.arm_offset, p.size);
  if (in_single()) {
    start_in_single();
    return;
  }
  if (layout.bonds != BondStorage::columns) {
    stored_ = store_bonds(b, layout.bonds);
    stored_pass_ = stored_pass_for(layout.bonds, world_.options.instruction_set);
  }
  if (layout.sums == Summation::all_atomic) {
    for (const Index row : b.row_lo) to_lo_.push_back(row | shared_row);
    for (const Index row : b.row_hi) to_hi_.push_back(row | shared_row);
  }
  if (layout.particles == ParticleStorage::columns) {
    const std::size_t sums = p.size + world_.bond_plan.slot_count;
    columns_ = {p.position.copy(), p.velocity.copy(), p.spin.copy(), Column<Vec3>(sums), Column<Vec3>(sums)};
  }
}

/// The scene, which ran in doubles, goes over to single precision.
void LayoutRun::start_in_single() {
  World& w = world_;
  const LoopKind kind{Precision::single, w.ledger.enabled};
  w.options.precision = Precision::single;
  w.features = built_features(w.laws.front(), w.features, kind);
  w.single_pass = single_pass_for(w.laws.front(), w.features, w.options.instruction_set);
  start_single(w);
  if (layout_.number == SumNumber::int32) return;
  sums_pass_ = sums_pass_for(layout_.number, w.options.instruction_set);
  (layout_.number == SumNumber::int64) ? long_sums_.resize(w.single.sums.size())
                                       : float_sums_.resize(w.single.sums.size());
}

/// Records say what a step of `dt` moves; dashpots are kept for it.
void LayoutRun::move_by(double dt) {
  if (dt == moved_by_) return;
  sync(world_);
  set_anchors(world_.single.quanta, world_.particles, dt);
  const Column<IntegerSums> sums = world_.single.sums;  // go on growing
  world_.dt = moved_by_ = dt;
  fill_single(world_);
  world_.single.sums = sums;
}

template <class Go>
void LayoutRun::with_sums(const Go& go) {
  if (!long_sums_.empty()) return go(long_sums_);
  if (!float_sums_.empty()) return go(float_sums_);
  go(world_.single.sums);
}

void LayoutRun::pass_in_single() {
  const SinglePassIn in = single_pass_in(world_);
  const ScatterPlan& plan = world_.bond_plan;
  std::mutex adds;
  for_ranges(threads_, [&](int range) {
    const std::size_t first = plan.first(range), last = plan.first(range + 1);
    std::vector<LoadApart> apart;
    if (sums_pass_)
      with_sums([&](auto& sums) { sums_pass_(in, sums.data(), first, last, apart); });
    else
      world_.single_pass(in, first, last, nullptr, apart);
    if (apart.empty()) return;
    const std::scoped_lock lock(adds);
    world_.single.apart.insert(world_.single.apart.end(), apart.begin(), apart.end());
  });
  if (!sums_pass_) return add_slots(world_.single, plan);
  with_sums([&](auto& sums) {
    for (std::size_t k = 0; k < plan.shared.size(); ++k)
      for (Index slot = plan.first_slot[k]; slot < plan.first_slot[k + 1]; ++slot) {
        auto& from = sums[plan.slots[slot]];
        auto& to = sums[plan.shared[k]];
        for (int c = 0; c < 3; ++c) to.force[c] += from.force[c], to.moment[c] += from.moment[c];
        from = {};
      }
  });
}

void LayoutRun::pass_over(const BondPassIn& in, std::size_t first, std::size_t last, const Scatter& to) {
  if (stored_pass_)
    stored_pass_(in, stored_.data(), first, last, to);
  else
    world_.bond_pass(in, bond_pass_history(world_), first, last, to, nullptr);
}

void LayoutRun::pass(double dt) {
  if (in_single()) {
    move_by(dt);
    return pass_in_single();
  }
  BondTable& b = world_.bonds;
  ScatterPlan& plan = world_.bond_plan;
  BondPassIn in = bond_pass_in(world_);
  in.dt = dt;
  Scatter to = scatter_view(plan, b.row_lo, b.row_hi, b.arm_offset, world_.particles);
  if (!to_lo_.empty()) to.to_lo = to_lo_, to.to_hi = to_hi_;
  if (layout_.sums == Summation::all_atomic) to.mode = ScatterMode::atomic;
  if (in_columns()) {
    in.position = columns_.position, in.velocity = columns_.velocity, in.spin = columns_.spin;
    to.force = columns_.force, to.torque = columns_.torque;
  }
  if (layout_.sums == Summation::colours) {
    for (std::size_t c = 0; c + 1 < first_of_colour_.size(); ++c) {
      const std::size_t first = first_of_colour_[c], bonds = first_of_colour_[c + 1] - first;
      for_ranges(threads_, [&](int range) {
        pass_over(in, first + range_first(bonds, range, threads_, bond_batch),
                  first + range_first(bonds, range + 1, threads_, bond_batch), to);
      });
    }
    return;
  }
  for_ranges(threads_, [&](int range) { pass_over(in, plan.first(range), plan.first(range + 1), to); });
  if (in_columns())
    collect_columns();
  else
    collect(plan, world_.particles, world_.partition.owned(), threads_);
}

/// As `collect` does for records.
void LayoutRun::collect_columns() {
  const ScatterPlan& plan = world_.bond_plan;
  for_rows(plan.shared.size(), threads_, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k)
      for (Index s = plan.first_slot[k]; s < plan.first_slot[k + 1]; ++s)
        for (Column<Vec3>* const sum : {&columns_.force, &columns_.torque}) {
          Vec3& own = (*sum)[plan.slots[s]];
          (*sum)[plan.shared[k]] += own;
          own = {};
        }
  });
}

void LayoutRun::clear_sums() {
  ParticleTable& p = world_.particles;
  std::fill(p.force.begin(), p.force.end(), Vec3{});
  std::fill(p.torque.begin(), p.torque.end(), Vec3{});
  std::fill(columns_.force.begin(), columns_.force.end(), Vec3{});
  std::fill(columns_.torque.begin(), columns_.torque.end(), Vec3{});
  world_.single.apart.clear();
  with_sums([](auto& sums) {
    std::fill(sums.begin(), sums.end(), typename std::decay_t<decltype(sums)>::value_type{});
  });
}

PassResult LayoutRun::result() {
  const ParticleTable& p = world_.particles;
  PassResult r;
  if (in_single()) {
    sync(world_);
    const double unit = world_.single.quanta.force;
    const auto in_si = [](const auto& of, double per_unit) {
      return per_unit *
             Vec3{static_cast<double>(of[0]), static_cast<double>(of[1]), static_cast<double>(of[2])};
    };
    with_sums([&](const auto& sums) {
      for (std::size_t k = 0; k < p.size; ++k) {
        r.force.push_back(in_si(sums[k].force, unit));
        r.torque.push_back(in_si(sums[k].moment, unit * p.radius[k]));
      }
    });
    ParticleTable apart = p;
    const std::vector<LoadApart> kept = world_.single.apart;
    add_apart(world_.single, apart, 0, p.size);
    world_.single.apart = kept;
    for (std::size_t k = 0; k < p.size; ++k)
      r.force[k] += apart.force[k] - p.force[k], r.torque[k] += apart.torque[k] - p.torque[k];
  }
  for (std::size_t k = 0; k < p.size && !in_single(); ++k) {
    r.force.push_back(in_columns() ? columns_.force[k] : p.force[k]);
    r.torque.push_back(in_columns() ? columns_.torque[k] : p.torque[k]);
  }
  BondTable b = world_.bonds;
  if (stored_pass_) restore_history(stored_, layout_.bonds, b);
  r.shear.resize(scene_bonds_);
  r.plastic_stretch.resize(scene_bonds_);
  r.damage_normal.resize(scene_bonds_);
  r.damage_shear.resize(scene_bonds_);
  // from the end: a bond comes before the padding that repeats it
  for (std::size_t k = b.size; k-- > 0;) {
    const std::size_t to = source_.empty() ? k : source_[k];
    r.shear[to] = {b.shear_x[k], b.shear_y[k], b.shear_z[k]};
    r.plastic_stretch[to] = b.plastic_stretch[k];
    r.damage_normal[to] = b.damage_normal[k];
    r.damage_shear[to] = b.damage_shear[k];
  }
  return r;
}

namespace {

double size_of(double a) { return std::abs(a); }
double size_of(const Vec3& a) { return norm(a); }

/// NaN where either has one.
template <class T>
double difference(const std::vector<T>& a, const std::vector<T>& b) {
  double most = 0, apart = 0;
  const auto keep_larger = [](double& kept, double value) { kept = value <= kept ? kept : value; };
  for (std::size_t k = 0; k < a.size(); ++k) {
    keep_larger(most, size_of(a[k]));
    keep_larger(apart, size_of(a[k] - b[k]));
  }
  return apart == 0.0 ? 0.0 : apart / most;
}

}  // namespace

double largest_difference(const PassResult& a, const PassResult& b) {
  double largest = 0;
  for (const double d :
       {difference(a.force, b.force), difference(a.torque, b.torque), difference(a.shear, b.shear),
        difference(a.plastic_stretch, b.plastic_stretch), difference(a.damage_normal, b.damage_normal),
        difference(a.damage_shear, b.damage_shear)})
    largest = d <= largest ? largest : d;
  return largest;
}

}  // namespace breccia
