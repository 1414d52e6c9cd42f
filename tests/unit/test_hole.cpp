// A hole along the axis: what is left of the section, and of a packing.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "core/packing/drill.hpp"
#include "tests/scene.hpp"

using namespace breccia;

TEST_CASE("hole: stresses are over the rest of the section, and no centre is left within [closed form]") {
  Body body = scene::small_cylinder();
  body.hole = 0.02;
  const Specimen whole = scene::small_packing(800), rest = drilled(whole, body);
  CHECK(rest.spheres.size() < whole.spheres.size());
  // the share of the section, to three standard deviations of so many spheres
  const double left = 1.0 - 0.02 * 0.02 / (0.05 * 0.05);
  CHECK(static_cast<double>(rest.spheres.size()) / 800.0 == doctest::Approx(left).epsilon(0.05));
  for (const SpecimenSphere& s : rest.spheres) CHECK(std::hypot(s.centre.x, s.centre.y) >= 0.01);
  const Assembly a = assemble(rest, body, {}, Features{}, 1);
  CHECK(a.section() == doctest::Approx(0.25 * std::numbers::pi * (0.05 * 0.05 - 0.02 * 0.02)).epsilon(1e-14));
  CHECK(a.load_section() == a.section());
  CHECK(a.lateral_surface() == doctest::Approx(std::numbers::pi * 0.05 * 0.10).epsilon(1e-14));
  CHECK(drilled(whole, scene::small_cylinder()).spheres.size() == whole.spheres.size());
}
