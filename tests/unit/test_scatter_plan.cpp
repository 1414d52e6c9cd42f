// Sums of forces by particle: the same, to round-off or to the bit, however the bonds are cut into
// ranges.
#include <doctest/doctest.h>

#include <random>

#include "core/base/threads.hpp"
#include "core/ranks/scatter_plan.hpp"

using namespace breccia;

namespace {

constexpr Features spinning{}, plain{.rotation = false};

struct Network {
  std::size_t bonds = 0;
  std::vector<Row> lo, hi;
  std::vector<Gid> gid_lo, gid_hi;
  std::vector<Vec3> force, moment;  ///< per bond
  std::vector<double> arm_offset;
  ParticleTable particles;
};

/// Bonds sorted by their ends, as in an assembly: neighbours in memory, and some that reach far.
Network network(std::size_t particles, std::size_t bonds, const Features& features) {
  Network n;
  n.bonds = bonds;
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> in(-1, 1);
  std::uniform_int_distribution<Row> any(0, static_cast<Row>(particles - 1)), near(1, 9);
  n.particles.resize(particles, features);
  for (std::size_t k = 0; k < particles; ++k) {
    n.particles.gid[k] = (k * 7919) % particles;
    n.particles.radius[k] = 1 + 0.5 * in(random);
  }
  std::vector<std::pair<Row, Row>> ends;
  while (ends.size() < bonds) {
    const Row a = any(random), b = ends.size() % 10
                                       ? std::min<Row>(a + near(random), static_cast<Row>(particles - 1))
                                       : any(random);
    if (a != b) ends.emplace_back(std::min(a, b), std::max(a, b));
  }
  std::sort(ends.begin(), ends.end());
  for (const auto& [a, b] : ends) {
    const bool rising = n.particles.gid[a] < n.particles.gid[b];
    n.lo.push_back(rising ? a : b), n.hi.push_back(rising ? b : a);
    n.gid_lo.push_back(n.particles.gid[n.lo.back()]), n.gid_hi.push_back(n.particles.gid[n.hi.back()]);
    n.force.push_back({in(random), in(random), in(random)});
    n.moment.push_back({in(random), in(random), in(random)});
    if (features.rotation) n.arm_offset.push_back(0.3 * in(random));
  }
  return n;
}

/// What a pass does with its range, in blocks as the bond pass makes them.
void add_range(const Network& n, const Scatter& to, std::size_t first, std::size_t last) {
  while (first < last) {
    const std::size_t count = std::min(last - first, ForceBuffer::capacity);
    ForceBuffer block;
    for (std::size_t k = 0; k < count; ++k) {
      block.load[k] = {n.force[first + k], n.moment[first + k]};
    }
    scatter(to, block, first, count);
    first += count;
  }
}

struct Sums {
  std::vector<Vec3> force, torque;
  bool operator==(const Sums&) const = default;
};

Sums sums_of(Network& n, ScatterKind kind, int ranges, std::size_t batch = 8) {
  ParticleTable& p = n.particles;
  const bool torques = !p.spin.empty();
  ScatterPlan plan = plan_scatter(kind, ranges, batch, n.lo, n.hi, n.gid_lo, n.gid_hi, n.arm_offset, p.size);
  const auto first = [&](RecordField& sum) { return Strided<Vec3>(sum).first(p.size); };
  Sums sums;
  for (int repeat = 0; repeat < 2; ++repeat) {  // twice: the ranges' own sums must be left empty
    std::ranges::fill(first(p.force), Vec3{});
    if (torques) std::ranges::fill(first(p.torque), Vec3{});
    const Scatter to = scatter_view(plan, n.lo, n.hi, n.arm_offset, p);
    for_ranges(ranges, [&](int range) { add_range(n, to, plan.first(range), plan.first(range + 1)); });
    collect(plan, p, {0, p.size}, ranges);
    const Sums before = sums;
    sums.force.assign(first(p.force).begin(), first(p.force).end());
    if (torques) sums.torque.assign(first(p.torque).begin(), first(p.torque).end());
    if (repeat == 1 && kind != ScatterKind::atomic) CHECK(sums == before);
  }
  return sums;
}

Sums serial(const Network& n) {
  Sums s{std::vector<Vec3>(n.particles.size), std::vector<Vec3>(n.particles.spin.size())};
  for (std::size_t b = 0; b < n.bonds; ++b) {
    s.force[n.lo[b]] += n.force[b];
    s.force[n.hi[b]] -= n.force[b];
    if (s.torque.empty()) continue;
    s.torque[n.lo[b]] += (0.5 + n.arm_offset[b]) * n.moment[b];
    s.torque[n.hi[b]] += (0.5 - n.arm_offset[b]) * n.moment[b];
  }
  return s;
}

double difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  REQUIRE(a.size() == b.size());
  double worst = 0;
  for (std::size_t k = 0; k < a.size(); ++k) worst = std::max(worst, norm(a[k] - b[k]));
  return worst;
}

}  // namespace

TEST_CASE(
    "scatter: every way and 1, 2, 3, 5, 8 ranges give the serial sums [some 20 addends of size 1: 1e-14]") {
  for (const Features& features : {spinning, plain}) {
    Network n = network(700, 4096 + 8, features);
    const Sums want = serial(n);
    for (const ScatterKind kind : {ScatterKind::atomic, ScatterKind::private_sums, ScatterKind::gather})
      for (const int ranges : {1, 2, 3, 5, 8}) {
        const Sums got = sums_of(n, kind, ranges);
        INFO("kind ", int(kind), ", ranges ", ranges);
        CHECK(difference(got.force, want.force) < 1e-14);
        CHECK(difference(got.torque, want.torque) < 3e-14);
      }
  }
}

TEST_CASE("scatter: more ranges than batches, and a batch of one, as for contacts [1e-14]") {
  Network n = network(40, 24, spinning);
  const Sums want = serial(n);
  for (const ScatterKind kind : {ScatterKind::atomic, ScatterKind::private_sums, ScatterKind::gather})
    for (const auto& [ranges, batch] :
         {std::pair{8, std::size_t{8}}, {5, std::size_t{1}}, {30, std::size_t{1}}})
      CHECK(difference(sums_of(n, kind, ranges, batch).force, want.force) < 1e-14);
}

TEST_CASE(
    "scatter: gather gives the same bits for any number of ranges, private the same bits from run to run "
    "[equal]") {
  Network n = network(3000, 16000, spinning);
  const Sums one = sums_of(n, ScatterKind::gather, 1);
  for (const int ranges : {2, 3, 5, 8}) CHECK(sums_of(n, ScatterKind::gather, ranges) == one);
  for (const int ranges : {2, 3, 5}) {
    const Sums first = sums_of(n, ScatterKind::private_sums, ranges);
    for (int run = 0; run < 5; ++run) CHECK(sums_of(n, ScatterKind::private_sums, ranges) == first);
  }
}

TEST_CASE(
    "scatter: ranges cover all bonds once, at multiples of the batch, own rows are touched by one range "
    "[exact]") {
  Network n = network(700, 4096 + 8, spinning);
  for (const int ranges : {1, 2, 3, 5, 8}) {
    const ScatterPlan plan =
        plan_scatter(ScatterKind::private_sums, ranges, 8, n.lo, n.hi, n.gid_lo, n.gid_hi, n.arm_offset, 700);
    CHECK(plan.first(0) == 0);
    CHECK(plan.first(ranges) == n.bonds);
    std::vector<int> toucher(700 + plan.slot_count, -1);
    bool alone = true, starts_right = true;
    for (int range = 0; range < ranges; ++range) {
      starts_right = starts_right && plan.first(range) % 8 == 0;
      for (std::size_t b = plan.first(range); ranges > 1 && b < plan.first(range + 1); ++b)
        for (const Index row : {plan.to_lo[b], plan.to_hi[b]}) {
          alone = alone && (toucher[row] == -1 || toucher[row] == range);
          toucher[row] = range;
        }
    }
    CHECK(alone);
    CHECK(starts_right);
    CHECK((ranges == 1 || plan.slot_count > 0));
    // with atomics: a row without the mark is touched from one range only
    const ScatterPlan atomic =
        plan_scatter(ScatterKind::atomic, ranges, 8, n.lo, n.hi, n.gid_lo, n.gid_hi, n.arm_offset, 700);
    std::vector<int> plain_toucher(700, -1);
    std::size_t marked = 0;
    bool unmarked_alone = true;
    for (int range = 0; range < ranges && ranges > 1; ++range)
      for (std::size_t b = atomic.first(range); b < atomic.first(range + 1); ++b)
        for (const auto& [to, row] : {std::pair{atomic.to_lo[b], n.lo[b]}, {atomic.to_hi[b], n.hi[b]}}) {
          CHECK_MESSAGE((to & ~shared_row) == row, "row kept");
          marked += (to & shared_row) != 0;
          if (to & shared_row) {
            unmarked_alone = unmarked_alone && plain_toucher[row] == -1;
            continue;
          }
          unmarked_alone = unmarked_alone && (plain_toucher[row] == -1 || plain_toucher[row] == range);
          plain_toucher[row] = range;
        }
    CHECK(unmarked_alone);
    CHECK((ranges == 1 || marked > 0));
  }
}
