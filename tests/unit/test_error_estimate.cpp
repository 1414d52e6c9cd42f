#include <doctest/doctest.h>

#include "core/loading/error_estimate.hpp"

using namespace breccia;

TEST_CASE("error estimate: each part follows what it is told from, and nothing else") {
  const ErrorEstimate e = estimate_error(1e-3, 0.02, 4e-5, 10000);
  CHECK(e.rate > 0.01);
  CHECK(e.rate < 0.03);
  CHECK(e.step == 4e-5);
  CHECK(!estimate_error(1e-3, 0.02, {}, 10000).step);
  CHECK(estimate_error(0, 0, {}, 10000).rate == 0.0);
  CHECK(estimate_error(2e-3, 0, {}, 1).rate == doctest::Approx(2 * estimate_error(1e-3, 0, {}, 1).rate));
  // four times the spheres, half the scatter
  CHECK(estimate_error(0, 0, {}, 40000).sampling == doctest::Approx(0.5 * e.sampling));
}
