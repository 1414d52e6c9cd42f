// The surface of packings against nominal bodies that fit and that do not.
#include <doctest/doctest.h>

#include "core/geometry/surface_fit.hpp"
#include "tests/scene.hpp"

using namespace breccia;

namespace {

struct Packing {
  std::vector<Vec3> centre;
  std::vector<double> radius;
  double mean_radius = 0;
};

Packing take(const Specimen& s, const Vec3& shift = {}) {
  Packing p;
  for (const SpecimenSphere& sphere : s.spheres) {
    p.centre.push_back(sphere.centre + shift), p.radius.push_back(sphere.radius);
    p.mean_radius += sphere.radius / static_cast<double>(s.spheres.size());
  }
  return p;
}

SurfaceFit fit(const Packing& p, const Body& body, Space space = Space::three_d) {
  return fit_surface(body, space, p.centre, p.radius, p.mean_radius);
}

void check_good(const SurfaceFit& f) {
  CHECK(judge(f.across) == Fit::good);
  if (f.depth) CHECK(judge(*f.depth) == Fit::good);
  if (f.height) CHECK(judge(*f.height) == Fit::good);
  CHECK(judge_offset(norm(f.offset)) == Fit::good);
}

}  // namespace

TEST_CASE("surface fit: packings of every shape fit the body they were packed into") {
  for (const std::size_t spheres : {100, 400, 1000})
    for (const Body& body : {Body{Shape::cylinder, 0.05, 0, 0.1}, Body{Shape::disc, 0.0378, 0, 0.0219},
                             Body{Shape::box, 0.05, 0.03, 0.1}})
      check_good(fit(take(pack_spheres(body, {.spheres = spheres, .sizes = {}, .seed = 3})), body));
  PackRequest discs{.spheres = 300, .sizes = {}, .porosity = 0.12, .seed = 3, .space = Space::two_d};
  const Body rectangle{Shape::box, 0.04, 1, 0.08}, circle{Shape::disc, 0.04, 0, 1};
  check_good(fit(take(pack_spheres(rectangle, discs)), rectangle, Space::two_d));
  check_good(fit(take(pack_spheres(circle, discs)), circle, Space::two_d));
}

TEST_CASE("surface fit: gaps are those of the nominal body, in mean radii") {
  const Packing p = take(scene::small_packing(1000));
  const SurfaceFit right = fit(p, scene::small_cylinder());
  for (const double mm : {-4.0, 1.0, 3.0}) {
    Body body = scene::small_cylinder();
    body.diameter += mm * 1e-3, body.height += 2 * mm * 1e-3;
    const SurfaceFit f = fit(p, body);
    const double expected = 0.5e-3 * mm / p.mean_radius;
    CHECK(f.across.median - right.across.median == doctest::Approx(expected).epsilon(0.1));
    CHECK(f.height->median - right.height->median == doctest::Approx(2 * expected).epsilon(0.1));
    CHECK((judge(f.across) == Fit::wrong) == (mm != 1.0));
  }
}

TEST_CASE("surface fit: an offset of the middle is found, and takes no part in the gaps") {
  const Body body = scene::small_cylinder();
  const Specimen s = scene::small_packing(1000);
  const SurfaceFit right = fit(take(s), body);
  const Vec3 shift{0.0015, -0.001, 0.0012};
  const Packing p = take(s, shift);
  const SurfaceFit f = fit(p, body);
  const Vec3 offset = p.mean_radius * (f.offset - right.offset);
  CHECK(norm(offset - shift) < 1e-4);
  CHECK(f.across.median == doctest::Approx(right.across.median).epsilon(0.2));
  CHECK(judge_offset(norm(f.offset)) == Fit::wrong);
}

TEST_CASE("surface fit: a core cut from a block is rough, and not wrong where its centres fill the body") {
  const Body block{Shape::box, 0.05, 0.05, 0.1}, core{Shape::cylinder, 0.04, 0, 0.1};
  Specimen s = pack_spheres(block, {.spheres = 1500, .sizes = {}, .seed = 3});
  std::erase_if(s.spheres, [](const auto& b) { return std::hypot(b.centre.x, b.centre.y) > 0.02; });
  const SurfaceFit f = fit(take(s), core);
  CHECK(f.across.roughness > 0.5);
  CHECK(judge(f.across) != Fit::wrong);
  std::erase_if(s.spheres,
                [](const auto& b) { return std::hypot(b.centre.x, b.centre.y) + b.radius > 0.02; });
  CHECK(judge(fit(take(s), core).across) == Fit::wrong);
}
