// Criteria on stress tensors against laboratory tests whose strength is a closed form
// (docs/model.md, B122).
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "core/fields/tensor_criteria.hpp"

using namespace breccia;

namespace {

constexpr double angle = std::numbers::pi / 6.0;  // of friction: sine 1/2
const TensorStrengths rock{3e6, 10e6, std::tan(angle)};

/// Pa, a cylinder at its Mohr-Coulomb strength under a pressure.
std::array<double, 3> triaxial(double pressure, double part = 1.0) {
  const double n = (1 + std::sin(angle)) / (1 - std::sin(angle));
  const double deviator = 2 * 10e6 * std::cos(angle) / (1 - std::sin(angle)) + (n - 1) * pressure;
  return {-pressure, -pressure, -pressure - part * deviator};
}

}  // namespace

TEST_CASE(
    "tensor criteria: strengths in tension and triaxial compression are met at 1 [closed form, 1e-12]") {
  CHECK(rankine_state({3e6, 0, 0}, rock) == doctest::Approx(1).epsilon(1e-12));
  CHECK(rankine_state({-1e6, -2e6, -9e6}, rock) == 0.0);
  for (const double pressure : {0.0, 5e6, 60e6}) {
    CHECK(mohr_coulomb_state(triaxial(pressure), rock) == doctest::Approx(1).epsilon(1e-12));
    CHECK(drucker_prager_state(triaxial(pressure), rock) == doctest::Approx(1).epsilon(1e-12));
    CHECK(mohr_coulomb_state(triaxial(pressure, 0.5), rock) < 0.8);
  }
  // even pressure alone never fails, whatever one plane alone would say
  CHECK(mohr_coulomb_state({-30e6, -30e6, -30e6}, rock) == 0.0);
  CHECK(drucker_prager_state({-30e6, -30e6, -30e6}, rock) == 0.0);
  // in extension the cone stands above the pyramid
  CHECK(drucker_prager_state({-1e6, -20e6, -20e6}, rock) < mohr_coulomb_state({-1e6, -20e6, -20e6}, rock));
  // beyond the tip
  CHECK(std::isinf(mohr_coulomb_state({40e6, 40e6, 39e6}, rock)));
}

TEST_CASE("tensor criteria: principal stresses of a turned tensor [closed form, 1e-12]") {
  // pure shear yz of 2, and 5 along x
  const auto p = principal_stresses({{5, 0, 0}, {2, 0, 0}});
  CHECK(p[0] == doctest::Approx(5).epsilon(1e-12));
  CHECK(p[1] == doctest::Approx(2).epsilon(1e-12));
  CHECK(p[2] == doctest::Approx(-2).epsilon(1e-12));
}
