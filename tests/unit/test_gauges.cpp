// Gauges on displacement fields that are known.
#include <doctest/doctest.h>

#include "core/elastic/gauges.hpp"
#include "tests/scene.hpp"

using namespace breccia;

TEST_CASE("gauges: an affine displacement gives its strains, whatever it is shifted by [(B76), 1e-14]") {
  const Assembly a = assemble(scene::small_packing(400), scene::small_cylinder(), {}, Features{}, 1);
  const auto& x = a.particles.reference_position;
  const Gauge axial = axial_gauge(a), radial = lateral_gauge(a);
  REQUIRE(axial.rows.size() > 100);
  REQUIRE(radial.rows.size() > 30);
  const auto strains = [&](auto displacement) {
    std::vector<Vec3> moved(x.size());
    for (std::size_t k = 0; k < x.size(); ++k) moved[k] = x[k] + displacement(x[k]);
    return std::pair{read_gauge(axial, moved, x, serial_partition(x.size())),
                     read_gauge(radial, moved, x, serial_partition(x.size()))};
  };
  // shortened by 2e-3 along z, widened by 5e-4 across; positive in compression
  const auto [e_z, e_r] = strains([](const Vec3& p) {
    return Vec3{5e-4 * p.x + 0.01, 5e-4 * p.y - 0.02, -2e-3 * p.z + 0.003};
  });
  CHECK(std::abs(e_z - 2e-3) < 1e-14);
  CHECK(std::abs(e_r + 5e-4) < 1e-14);
  // a turn about the axis, and shear across it, are no strain of either gauge
  const auto [t_z, t_r] = strains([](const Vec3& p) { return Vec3{-1e-3 * p.y, 1e-3 * p.x, 0}; });
  CHECK(std::abs(t_z) < 1e-16);
  CHECK(std::abs(t_r) < 1e-15);
  // the axial gauge reads no further than the middle half
  const auto [m_z, m_r] = strains([](const Vec3& p) {
    return Vec3{0, 0, std::abs(p.z) < 0.025 ? 1e-3 * p.z : 7.0};
  });
  CHECK(std::abs(m_z + 1e-3) < 1e-14);
  CHECK(m_r == 0);
  // and the radial one no further than the middle 40 % of the lateral surface
  const auto [far, r_r] = strains([](const Vec3& p) {
    return std::abs(p.z) < 0.02 && at_lateral_surface(scene::small_cylinder(), Space::three_d, p, 0, 0.02)
               ? Vec3{1e-3 * p.x, 1e-3 * p.y, 0}
               : Vec3{};
  });
  CHECK(far == 0);
  CHECK(r_r < 0);
  for (const Row row : radial.rows) {
    CHECK(std::abs(x[row].z) < 0.02);
    CHECK(std::binary_search(a.lateral.begin(), a.lateral.end(), row));
  }
}

TEST_CASE(
    "gauges: of a standing disc and of a rectangle in a plane the widening along x alone [(B78) 1e-14]") {
  for (const bool disc : {true, false}) {
    Assembly a = assemble(scene::small_packing(400), scene::small_cylinder(), {}, Features{}, 1);
    if (disc)
      a.body = {Shape::disc, 0.05, 0, 0.10, true};  // pressed along z over its diameter
    else
      a.space = Space::two_d;
    const auto& x = a.particles.reference_position;
    const Gauge g = lateral_gauge(a);
    std::size_t within =
        0;  // all particles of a disc, the lateral surface of others, in the middle 40 % of what is pressed
    for (std::size_t k = 0; k < x.size(); ++k)
      within += std::abs(x[k].z) < 0.2 * (disc ? 0.05 : 0.10) &&
                (disc || std::binary_search(a.lateral.begin(), a.lateral.end(), static_cast<Row>(k)));
    CHECK(g.rows.size() == within);
    std::vector<Vec3> moved;
    for (const Vec3& p : x) moved.push_back(p + Vec3{5e-4 * p.x + 0.01, -7e-4 * p.y + 1, 3e-4 * p.z});
    INFO("disc ", disc);
    CHECK(std::abs(read_gauge(g, moved, x, serial_partition(x.size())) + 5e-4) < 1e-14);
  }
}
