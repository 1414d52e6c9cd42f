// The layouts of the study: all of them compute what production does, and the limits they are held
// against are counted right.
#include <doctest/doctest.h>

#include <limits>
#include <random>

#include "core/stepping/step.hpp"
#include "core/studies/layouts/layout_study.hpp"
#include "core/studies/layouts/machine_rates.hpp"
#include "core/world/energies.hpp"
#include "core/world/loop_views.hpp"
#include "core/world/make_world.hpp"
#include "kernels/laws/bond_force.hpp"
#include "tests/scene.hpp"

using namespace breccia;
namespace ref = breccia::reference;

namespace {

/// A small cylinder, crushed until bonds have yielded and broken and others are about to.
World crushed(InstructionSet set) {
  ref::Parameters p;
  p.alpha = 0.8;
  p.delta_n = 0.5, p.delta_s = 0.4;
  const Assembly a = assemble(scene::small_packing(150), scene::small_cylinder(), {}, Features{}, 1);
  WorldOptions o = scene::options(p);
  o.instruction_set = set;
  World w = make_world(a, scene::material_of(p), scene::factor(p), o);
  for (int k = 0; k < 150; ++k) {
    scene::drive(w, 6, -6);
    advance(w);
  }
  // a leap, so that bonds yield, soften and break in the next pass
  for (std::size_t k = 0; k < w.particles.size; ++k)
    w.particles.position[k] += 20 * w.dt * w.particles.velocity[k];
  return w;
}

/// `passes` of production's kernel over all bonds at once, sums begun anew in each.
PassResult production(World w, int passes) {
  PassResult r;
  BondTable& b = w.bonds;
  for (int k = 0; k < passes; ++k) {
    r.force.assign(w.particles.size, {}), r.torque.assign(w.particles.size, {});
    Scatter to;
    to.to_lo = b.row_lo, to.to_hi = b.row_hi, to.arm_offset = b.arm_offset;
    to.force = r.force, to.torque = r.torque;
    w.bond_pass(bond_pass_in(w), bond_pass_history(w), 0, b.padded, to, nullptr);
  }
  for (std::size_t k = 0; k < b.size; ++k) r.shear.push_back({b.shear_x[k], b.shear_y[k], b.shear_z[k]});
  const auto bonds = static_cast<std::ptrdiff_t>(b.size);
  r.plastic_stretch.assign(b.plastic_stretch.begin(), b.plastic_stretch.begin() + bonds);
  r.damage_normal.assign(b.damage_normal.begin(), b.damage_normal.begin() + bonds);
  r.damage_shear.assign(b.damage_shear.begin(), b.damage_shear.begin() + bonds);
  return r;
}

}  // namespace

TEST_CASE("layouts: all give production's forces and history on a crushed cylinder [rel 1e-12]") {
  for (const InstructionSet set : scene::sets_of_this_machine()) {
    const World w = crushed(set);
    const PassResult before = production(w, 0), wanted = production(w, 4);
    REQUIRE(count_broken(w).tension > 20);
    REQUIRE(std::ranges::count_if(wanted.plastic_stretch, [](double u) { return u < 0.0; }) > 20);
    REQUIRE(before.plastic_stretch != wanted.plastic_stretch);
    REQUIRE(before.damage_normal != wanted.damage_normal);
    REQUIRE(before.damage_shear != wanted.damage_shear);
    REQUIRE(before.shear != wanted.shear);
    for (const int threads : {1, 2, 3})
      for (const Layout& layout : layouts) {
        if (layout.precision == Precision::single) continue;
        LayoutRun run(w, layout, threads);
        for (int k = 0; k < 4; ++k) {
          run.clear_sums();
          run.pass(w.dt);
        }
        INFO(name_of(set), ", ", name_of(layout.precision), ", threads ", threads, ", bonds ",
             name_of(layout.bonds), ", particles ", name_of(layout.particles), ", sums ",
             name_of(layout.sums));
        CHECK(largest_difference(run.result(), wanted) <
              (layout.precision == Precision::single ? 1e-5 : 1e-12));
      }
  }
}

TEST_CASE(
    "layouts: in single precision all have the same sums, of floats to 1e-6, and on a gentle scene those of "
    "doubles [1e-5]") {
  for (const InstructionSet set : scene::sets_of_this_machine()) {
    const World wild = crushed(set);
    World gentle = wild;  // at rest where it is
    std::fill(gentle.particles.velocity.begin(), gentle.particles.velocity.end(), Vec3{});
    std::fill(gentle.particles.spin.begin(), gentle.particles.spin.end(), Vec3{});
    for (const World& w : {wild, gentle}) {
      const auto passed = [&](const Layout& layout, int threads) {
        LayoutRun run(w, layout, threads);
        for (int k = 0; k < 3; ++k) {
          run.clear_sums();
          run.pass(w.dt);
        }
        return run.result();
      };
      const PassResult wanted = passed(single_layout, 1);
      for (const int threads : {1, 2, 3})
        for (const Layout& layout : layouts) {
          if (layout.precision != Precision::single) continue;
          INFO(name_of(set), ", threads ", threads, ", sums ", name_of(layout.sums), " of ",
               numbers_of(layout));
          CHECK(largest_difference(passed(layout, threads), wanted) <=
                (layout.number == SumNumber::float32 ? 1e-6 : 0.0));
        }
      if (w.particles.velocity[0] == Vec3{}) CHECK(largest_difference(wanted, production(w, 3)) < 1e-5);
    }
  }
}

TEST_CASE("layouts: sums that are not cleared go on growing") {
  const World w = crushed(best_instruction_set());
  for (const Layout& layout : layouts) {
    LayoutRun run(w, layout, 2);
    // in single precision so short that nothing moves
    const double dt = layout.precision == Precision::single ? 1e-12 * w.dt : 0.0;
    run.pass(dt);
    PassResult twice = run.result();
    for (Vec3& f : twice.force) f = 2.0 * f;
    for (Vec3& t : twice.torque) t = 2.0 * t;
    run.pass(dt);
    INFO(name_of(layout.precision), ", bonds ", name_of(layout.bonds), ", particles ",
         name_of(layout.particles), ", sums ", name_of(layout.sums));
    CHECK(largest_difference(run.result(), twice) < (layout.precision == Precision::single ? 1e-6 : 1e-12));
  }
}

TEST_CASE("layouts: records and blocks keep what the bonds remember [equal]") {
  const World w = crushed(best_instruction_set());
  for (const BondStorage storage : {BondStorage::records, BondStorage::blocks_8, BondStorage::blocks_16}) {
    BondTable restored = w.bonds;
    const StoredBonds stored = store_bonds(w.bonds, storage);
    for (auto* column : {&restored.shear_x, &restored.shear_y, &restored.shear_z, &restored.plastic_stretch,
                         &restored.damage_normal, &restored.damage_shear})
      std::fill(column->begin(), column->end(), -1.0);
    restore_history(stored, storage, restored);
    INFO(name_of(storage));
    CHECK(restored.shear_x == w.bonds.shear_x);
    CHECK(restored.shear_y == w.bonds.shear_y);
    CHECK(restored.shear_z == w.bonds.shear_z);
    CHECK(restored.plastic_stretch == w.bonds.plastic_stretch);
    CHECK(restored.damage_normal == w.bonds.damage_normal);
    CHECK(restored.damage_shear == w.bonds.damage_shear);
  }
  CHECK_THROWS(stored_pass_for(BondStorage::columns, InstructionSet::x86_64));
}

TEST_CASE("layouts: bonds of a colour share no particle and every bond has one colour") {
  const World w = crushed(best_instruction_set());
  const ColouredBonds c = colour_bonds(w.bonds, w.particles.size);
  const BondTable& b = c.bonds;
  std::vector<int> seen(w.bonds.size);
  for (std::size_t colour = 0; colour + 1 < c.first.size(); ++colour) {
    CHECK(c.first[colour] % bond_batch == 0);
    std::set<Row> ends;
    std::size_t bonds = 0;
    for (std::size_t k = c.first[colour]; k < c.first[colour + 1]; ++k) {
      CHECK(b.row_lo[k] == w.bonds.row_lo[c.source[k]]);
      if (b.stiffness[k] == 0.0) continue;  // padding
      ends.insert(b.row_lo[k]), ends.insert(b.row_hi[k]);
      ++seen[c.source[k]], ++bonds;
    }
    CHECK(ends.size() == 2 * bonds);
  }
  CHECK(c.first.back() == b.padded);
  CHECK(std::ranges::all_of(seen, [](int times) { return times == 1; }));
}

TEST_CASE("layouts: the difference of two results is that of the worst column over its own largest value") {
  PassResult a;
  a.force = {{3, 4, 0}, {0, 0, 1}};
  a.torque = {{0, 0, 0}, {0, 0, 0}};
  a.shear = {{1, 0, 0}};
  a.plastic_stretch = {-1e-9};
  a.damage_normal = a.damage_shear = {0};
  PassResult b = a;
  CHECK(largest_difference(a, b) == 0.0);
  b.force[1].z = 1.5;
  CHECK(largest_difference(a, b) == doctest::Approx(0.1));
  b.plastic_stretch[0] = -0.8e-9;
  CHECK(largest_difference(a, b) == doctest::Approx(0.2));
  b.shear[0].y = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(largest_difference(a, b) <= allowed_difference(Precision::full));
}

TEST_CASE("layouts: operations are counted one by one") {
  const Vec<Counted> a{1, 2, 3}, b{4, 5, 6};
  const OperationCount of_dot = operations_of([&] { CHECK(dot(a, b).value() == 32); });
  CHECK(of_dot.total() == 5);
  CHECK(of_dot.additions == 2);
  CHECK(of_dot.multiplications == 3);
  CHECK(operations_of([&] { (void)cross(a, b); }).total() == 9);
  const OperationCount mixed = operations_of([&] { (void)larger(-sqrt(a.x) / b.x, b.y); });
  CHECK(mixed.roots == 1);
  CHECK(mixed.divisions == 1);
  CHECK(mixed.comparisons == 1);
  CHECK(mixed.total() == 2);
}

TEST_CASE("layouts: an intact bond takes one root and one division") {
  const OperationCount n = operations_per_bond();
  CHECK(n.roots == 1);
  CHECK(n.divisions == 1);
  CHECK(n.total() == n.additions + n.multiplications + 2);
  CHECK(n.total() > 150);
  CHECK(n.total() < 300);
  CHECK(n.comparisons > 0);
}

TEST_CASE(
    "layouts: an intact bond in single precision takes two roots, two divisions, fewer operations in all") {
  const OperationCount n = single_operations_per_bond();
  CHECK(n.roots == 2);
  CHECK(n.divisions == 2);
  CHECK(n.total() > 100);
  CHECK(n.total() < operations_per_bond().total());
}

TEST_CASE("layouts: bytes per bond are those of the declared columns") {
  const World w = crushed(best_instruction_set());
  const ByteCount n = bytes_per_bond(w.bonds, w.particles);
  const double share = static_cast<double>(w.particles.size) / static_cast<double>(w.bonds.size);
  const double ends = 2 * 4, constants = 5 * 8, history = 6 * 8, motion = 3 * 32, sums = 2 * 32;
  CHECK(n.read == doctest::Approx(ends + constants + history + share * (motion + sums)));
  CHECK(n.written == doctest::Approx(3 * 8 + share * sums));
  CHECK(n.set == doctest::Approx(n.read));
  CHECK(n.moved() == doctest::Approx(n.read + n.written));
}

TEST_CASE("layouts: bytes per bond in single precision are those of blocks, records and sums") {
  const World w = crushed(best_instruction_set());
  const ByteCount n = single_bytes_per_bond(w.bonds, w.particles);
  const double share = static_cast<double>(w.particles.size) / static_cast<double>(w.bonds.size);
  CHECK(n.read == doctest::Approx(2 * 4 + 8 * 4 + 1.0 / 16 + share * (64 + 32)));
  CHECK(n.written == doctest::Approx(3 * 4 + share * 32));
}

TEST_CASE("layouts: the limit is the longer of memory and arithmetic") {
  const MachinePeak peak{20e9, 50e9};
  const PassLimit memory = limit_of(peak, 200, 250), arithmetic = limit_of(peak, 20, 250);
  CHECK(memory.time() == doctest::Approx(10e-9));
  CHECK(arithmetic.time() == doctest::Approx(5e-9));
  LayoutResult r;
  r.limit = memory;
  r.block_ns = {50, 20, 25, 30};
  CHECK(r.median() == doctest::Approx(27.5));
  r.block_ns.push_back(20);
  CHECK(r.median() == 25);
  CHECK(r.spread().least == 20);
  CHECK(r.spread().most == 50);
  CHECK(r.bonds_per_second() == doctest::Approx(40e6));
  CHECK(r.fraction_of_limit() == doctest::Approx(0.4));
}

TEST_CASE("layouts: rates of the machine come from work that was done") {
  for (const InstructionSet set : scene::sets_of_this_machine()) {
    const MachineRates& rates = machine_rates(set);
    const std::vector<double> a(19, 1.0), b(19, 2.0), c(19, 3.0);
    std::vector<double> d(19, 10.0);
    rates.stream({a.data(), b.data(), c.data(), d.data()}, 0, 16, 2);
    INFO(name_of(set));
    CHECK(d[0] == 2.5);  // ((6 + 10)/4 + 6)/4
    CHECK(d[15] == 2.5);
    CHECK(d[16] == 10.0);
    // chains begin at 1 ... 12 and tend to 1
    const double lanes = rates.operations_per_round / 24;
    CHECK(rates.multiply_add(0) == doctest::Approx(78 * lanes));
    CHECK(rates.multiply_add(1'000'000) == doctest::Approx((12 + 66 * std::exp(-1.0)) * lanes).epsilon(1e-5));
    const MachinePeak peak = measure_peak(set, 1, 1e5, 1, 1e-4);
    CHECK(peak.bandwidth > 0);
    CHECK(peak.operations > 0);
  }
}
