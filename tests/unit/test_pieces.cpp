// What of a specimen hangs together, and what hangs on nothing.
#include <doctest/doctest.h>

#include "core/bonding/pieces.hpp"
#include "core/boundary/platens_and_confinement.hpp"
#include "core/elastic/gauges.hpp"
#include "tests/scene.hpp"

using namespace breccia;

namespace {

/// Group of each sphere of a packing by where it lies.
template <class Group>
Assembly grouped(const Group& group) {
  Specimen s = scene::small_packing(400);
  for (SpecimenSphere& sphere : s.spheres) sphere.group = group(sphere.centre);
  return assemble(s, scene::small_cylinder(), {}, Features{}, 1);
}

}  // namespace

TEST_CASE("pieces: numbered by size, the largest first") {
  const std::vector<RowPair> links{{0, 1}, {3, 4}, {4, 5}, {6, 7}, {5, 3}};
  const Pieces p = pieces_of(9, links);
  CHECK(p.sizes == std::vector<std::size_t>{3, 2, 2, 1, 1});
  CHECK(p.of == std::vector<std::uint32_t>{1, 1, 3, 0, 0, 0, 2, 2, 4});
  CHECK(pieces_of(3, {}).sizes == std::vector<std::size_t>{1, 1, 1});
}

TEST_CASE("pieces: nothing is left out of a good packing") {
  Assembly a = grouped([](const Vec3&) { return 1; });
  const std::vector<Row> skin = a.lateral;
  const Connection c = leave_out_loose(a, true, 1);
  CHECK(c.pieces == std::vector<std::size_t>{400});
  CHECK(c.loose == 0);
  CHECK(c.unbonded == 0);
  CHECK(c.by_bonds);
  CHECK(a.lateral == skin);
}

TEST_CASE("pieces: spheres without a bond are in no pressed surface and in no gauge") {
  const auto loose = [](const Vec3& x) { return x.x > 0.015 && std::abs(x.z) < 0.02; };
  Assembly a = grouped([&](const Vec3& x) { return loose(x) ? 0 : 1; });
  const Connection c = leave_out_loose(a, true, 1);
  REQUIRE(c.unbonded > 5);
  CHECK(c.loose == c.unbonded);
  CHECK(c.joined);
  for (const Row row : a.lateral) CHECK(!loose(a.particles.position[row]));
  for (const Gauge& g : {axial_gauge(a), lateral_gauge(a)}) {
    REQUIRE(g.rows.size() > 20);
    for (const Row row : g.rows) CHECK(!loose(a.particles.position[row]));
  }
}

TEST_CASE("pieces: a specimen whose halves only touch is joined by contacts, one pulled apart by nothing") {
  Assembly touching = grouped([](const Vec3& x) { return x.z < 0 ? 1 : 2; });
  const Connection c = leave_out_loose(touching, true, 1);
  CHECK(c.pieces.size() == 2);
  CHECK(!c.by_bonds);
  CHECK(c.joined);
  CHECK(c.loose == 0);
  Assembly in_tension = grouped([](const Vec3& x) { return x.z < 0 ? 1 : 2; });
  CHECK(!leave_out_loose(in_tension, false, 1).joined);
}

TEST_CASE("pieces: a stray sphere belongs to no body, however far it is") {
  for (const double away : {0.06, 5.0, 1e12}) {
    Specimen s = scene::small_packing(400);
    s.spheres.push_back({9000, {0, 0, away}, 0.003});
    const MainBody body = main_body(s, 0.1, 1);
    CHECK(body.has.back() == 0);
    CHECK(std::count(body.has.begin(), body.has.end(), 1) == 400);
    CHECK(body.pieces == 1);
  }
  Specimen halves = scene::small_packing(400);
  for (SpecimenSphere& s : halves.spheres) s.centre.x += s.centre.x < 0 ? -0.003 : 0.003;
  CHECK(main_body(halves, 0.1, 1).pieces == 2);
}
