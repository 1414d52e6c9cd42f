// What an assembly is made of: areas of the strengths beside those of the stiffness, bonds without
// a face, the bodies that the loading holds, a disc that is stood up.
#include <doctest/doctest.h>

#include "core/bonding/bond_area.hpp"
#include "core/stepping/step.hpp"
#include "core/world/energies.hpp"
#include "core/world/make_world.hpp"
#include "io/specimens/read_specimen.hpp"
#include "tests/scene.hpp"

using namespace breccia;

namespace {

double determinant(const Vec3& a, const Vec3& b, const Vec3& c) { return dot(a, cross(b, c)); }

}  // namespace

TEST_CASE(
    "strength area: stiffness keeps its area - strengths have theirs without alpha - faceless pairs are "
    "counted [exact]") {
  const Specimen& specimen = scene::small_packing(500);
  const Assembly plain = assemble(specimen, scene::small_cylinder(), {}, Features{}, 1);
  BondingRule rule;
  rule.range = 0.3;  // far enough for pairs that others shield
  const Assembly wide = assemble(specimen, scene::small_cylinder(), rule, Features{}, 1);
  const std::vector<double> face =
      bond_areas(AreaRule::voronoi, wide.particles, wide.bonds, wide.lateral, wide.body, Space::three_d, 1);
  rule.strength_area = AreaRule::voronoi;
  const Assembly both = assemble(specimen, scene::small_cylinder(), rule, Features{}, 1);
  std::size_t faceless = 0, wrong = 0, row = 0;
  for (std::size_t k = 0; k < wide.bonds.size; ++k) {
    if (!(face[k] > 0)) {
      ++faceless;
      continue;
    }
    REQUIRE(row < both.bonds.size);
    wrong += both.bonds.gid_lo[row] != wide.bonds.gid_lo[k] || both.bonds.gid_hi[row] != wide.bonds.gid_hi[k];
    wrong += both.bonds.area[row] != wide.bonds.area[k] || both.bonds.strength_area[row] != face[k];
    ++row;
  }
  CHECK(wrong == 0);
  CHECK(row == both.bonds.size);
  CHECK(faceless > 10);
  CHECK(both.dropped_bonds == faceless);
  CHECK(wide.dropped_bonds == 0);
  CHECK(both.coordination == doctest::Approx(2.0 * double(row) / 500).epsilon(1e-14));
  CHECK(plain.bonds.strength_area.empty());
  for (std::size_t k = both.bonds.size; k < both.bonds.padded; ++k) CHECK(both.bonds.strength_area[k] > 0);

  AreaFactor factor;
  factor.alpha = 0.7, factor.shear_ratio = 0.4;
  WorldOptions o;
  const World w = make_world(both, scene::material_of({}), factor, o);
  for (std::size_t k = 0; k < w.bonds.size; k += 37) {
    const double sum = w.particles.radius[w.bonds.row_lo[k]] + w.particles.radius[w.bonds.row_hi[k]];
    CHECK(w.bonds.strength_area[k] == both.bonds.strength_area[k]);
    CHECK(w.bonds.stiffness[k] ==
          doctest::Approx(28e9 * 0.7 * both.bonds.area[k] / std::max(w.bonds.rest_length[k], 0.2 * sum))
              .epsilon(1e-13));
  }
}

TEST_CASE(
    "strength area: a bond breaks at sigma_t and tau_f of its strength area - at the stiffness of the other "
    "[1e-3]") {
  for (const double ratio : {0.5, 1.0, 3.0})
    for (const Vec3 along : {Vec3{0, 0, 1}, Vec3{1, 0, 0}}) {
      reference::Parameters p;
      p.delta_n = p.delta_s = 0;
      p.tau_f = 2e6;
      p.contact_damping = p.plasticity = false;
      p.xi = 0;
      Assembly a = scene::free_body({{1, 0.01, {0, 0, -0.01}}, {2, 0.01, {0, 0, 0.01}}}, p.beta,
                                    scene::options(p).features);
      const double A = std::numbers::pi * 1e-4, k_n = p.E * A / 0.02, k = along.z > 0 ? k_n : k_n / 2.4;
      a.bonds.strength_area.assign(a.bonds.padded, ratio * A);
      a.particles.free = 0, a.first_top = 1;
      World w = make_world(a, scene::material_of(p), scene::factor(p), scene::options(p));
      w.particles.mass.assign(2, 1e9);  // too heavy to roll
      const double limit = (along.z > 0 ? p.sigma_t : p.tau_f) * ratio * A, speed = limit / k / 1000.5 / w.dt;
      w.platens.velocity = {Vec3{}, speed * along};
      w.particles.velocity[1] = speed * along;
      double most = 0, before = 0, rise = 0;
      for (int n = 0; n < 1500; ++n) {
        advance(w);
        const double force = std::abs(dot(w.platens.force[1], along));
        if (n == 1) rise = force - before;
        before = force;
        most = std::max(most, force);
      }
      INFO("ratio ", ratio, ", along z ", along.z);
      CHECK(rise == doctest::Approx(limit / 1000.5).epsilon(1e-3));
      CHECK(most == doctest::Approx(limit * 1000 / 1000.5).epsilon(1e-3));
      CHECK(count_broken(w).tension + count_broken(w).shear == 1);
    }
}

TEST_CASE(
    "disc: standing up is a rotation that puts the load axis along z and the disc's along y - for each pair "
    "[exact]") {
  for (const char axis : {'x', 'y', 'z'})
    for (const char load : {'x', 'y', 'z', '-'}) {
      if (load == axis) continue;
      // the ends of the file's three axes, as spheres; the origin is their middle by decree
      Specimen file;
      file.spheres = {{1, {1, 0, 0}, 0.1}, {2, {0, 1, 0}, 0.1}, {3, {0, 0, 1}, 0.1}};
      const Specimen lying = place_specimen(file, axis, Vec3{});
      const Specimen up = stand_disc(lying, axis, load == '-' ? std::nullopt : std::optional(load));
      const Vec3 &x = up.spheres[0].centre, &y = up.spheres[1].centre, &z = up.spheres[2].centre;
      INFO("axis ", axis, ", load ", load);
      CHECK(determinant(x, y, z) == 1);
      CHECK(dot(x, x) == 1);
      CHECK(dot(y, y) == 1);
      CHECK(dot(z, z) == 1);
      CHECK(dot(x, y) == 0);
      CHECK(dot(y, z) == 0);
      CHECK(dot(z, x) == 0);
      CHECK(std::abs(up.spheres[std::size_t(axis - 'x')].centre.y) == 1);
      const char pressed = load != '-' ? load : axis == 'z' ? 'y' : 'z';
      CHECK(std::abs(up.spheres[std::size_t(pressed - 'x')].centre.z) == 1);
      CHECK(up.spheres[0].id == 1);
    }
}

TEST_CASE(
    "grip: strips hold what reaches within 0.15 R of the load's line and 2.5 radii of the lateral surface - "
    "no more "
    "[equal]") {
  Body disc{Shape::disc, 0.05, 0, 0.02};
  PackRequest r;
  r.spheres = 600;
  const Specimen up = stand_disc(pack_spheres(disc, r), 'z', std::nullopt);
  disc.on_edge = true;
  BondingRule rule;
  rule.grip = Support::strips;
  const Assembly a = assemble(up, disc, rule, Features{}, 1);
  double mean = 0;
  for (const auto& s : up.spheres) mean += s.radius / 600;
  std::size_t wrong = 0, lower = 0, upper = 0;
  for (std::size_t k = 0; k < a.particles.size; ++k) {
    const Vec3& x = a.particles.position[k];
    const bool within =
        std::abs(x.x) < 0.15 * 0.025 && std::hypot(x.x, x.z) + a.particles.radius[k] > 0.025 - 2.5 * mean;
    wrong += within != (k >= a.particles.free);
    if (!within) continue;
    wrong += (x.z > 0) != (k >= a.first_top);
    ++(x.z > 0 ? upper : lower);
  }
  CHECK(wrong == 0);
  CHECK(lower > 2);
  CHECK(upper > 2);
  CHECK(a.first_top - a.particles.free == lower);
  // a load P gives 2 P/(pi D L)
  CHECK(a.load_section() == doctest::Approx(std::numbers::pi * 0.05 * 0.02 / 2).epsilon(1e-14));
  CHECK(a.length() == 0.05);
  CHECK(a.layer == doctest::Approx(2.5 * mean).epsilon(1e-12));
}

TEST_CASE(
    "grip: halves hold the ends and the lateral surface on either side of a band of five mean radii "
    "[equal]") {
  BondingRule rule;
  rule.grip = Support::halves;
  const Assembly a = assemble(scene::small_packing(800), scene::small_cylinder(), rule, Features{}, 1);
  double mean = 0;
  for (const double r : a.particles.radius) mean += r / 800;
  std::size_t wrong = 0, band = 0, held = 0, by_lateral = 0;
  for (std::size_t k = 0; k < a.particles.size; ++k) {
    const Vec3& x = a.particles.position[k];
    const bool end = std::abs(x.z) > 0.05 - 1.5 * mean;
    const bool lateral = std::hypot(x.x, x.y) + a.particles.radius[k] > 0.025 - 0.3 * mean;
    const bool want = end || (lateral && std::abs(x.z) > 2.5 * mean);
    wrong += want != (k >= a.particles.free);
    if (want) wrong += (x.z > 0) != (k >= a.first_top);
    held += want, band += lateral && !want, by_lateral += want && !end;
  }
  CHECK(wrong == 0);
  CHECK(band > 5);
  CHECK(by_lateral > 50);
  CHECK(held < 700);
  CHECK(a.load_section() == doctest::Approx(std::numbers::pi * 0.025 * 0.025).epsilon(1e-14));
}

TEST_CASE(
    "assembly: the strips of a disc are as wide and as deep as asked for, planes hold nobody [(B61), "
    "exact]") {
  const Body body{Shape::disc, 0.05, 0, 0.02, true};
  Specimen s;
  Gid id = 0;
  for (int x = -12; x <= 12; ++x)
    for (int z = -12; z <= 12; ++z)
      if (std::hypot(x, z) <= 12) s.spheres.push_back({++id, {0.002 * x, 0, 0.002 * z}, 0.001, 1});
  const auto held = [&](const Strips& strips) {
    BondingRule rule;
    rule.grip = Support::strips, rule.strips = strips;
    return assemble(s, body, rule, Features{}, 1);
  };
  for (const auto& [width, depth] : {std::pair{0.009, 0.0025}, {0.0035, 0.0055}}) {
    const Assembly a = held({false, width, depth});
    CHECK(a.strip_width == width);
    std::size_t wanted = 0;
    for (const SpecimenSphere& sphere : s.spheres)
      wanted += std::abs(sphere.centre.x) < 0.5 * width &&
                std::hypot(sphere.centre.x, sphere.centre.z) + 0.001 > 0.025 - depth;
    CHECK(a.particles.size - a.particles.free == wanted);
    for (std::size_t row = a.particles.free; row < a.particles.size; ++row)
      CHECK((row < a.first_top) == (a.particles.position[row].z < 0));
  }
  CHECK(held({}).strip_width == doctest::Approx(0.15 * 0.05));
  CHECK(held({}).layer == doctest::Approx(2.5 * 0.001));
  const Assembly planes = held({true, {}, {}});
  CHECK(planes.particles.free == planes.particles.size);
  BondingRule shallow;
  shallow.grip = Support::strips, shallow.strips.depth = 1e-3;
  const Body wider{Shape::disc, 0.06, 0, 0.02, true};  // no sphere reaches its rim
  CHECK_THROWS_WITH_AS(assemble(s, wider, shallow, Features{}, 1), doctest::Contains("test.strip_depth"),
                       BadInput);
}
