// Rows of a curve: means over steps, merged in pairs when they become many.
#include <doctest/doctest.h>

#include "core/loading/recorder.hpp"

using namespace breccia;

namespace {

Reading reading(int step) {
  return {1e-3 * step, 1e-5 * step,  2e-5 * step, 1e6 * step,
          3e4 * step,  -1e-6 * step, 4e-6 * step, 7.0 * step};
}

/// Steps 1 ... n, what is known at a row's end counting the steps.
Recorder record(std::size_t capacity, std::size_t steps_per_row, int steps) {
  Recorder r;
  r.capacity = capacity;
  r.steps_per_row = steps_per_row;
  for (int k = 1; k <= steps; ++k)
    if (add_reading(r, reading(k))) {
      CurveRow end;
      end.broken_tension = k;
      end.kinetic_J = 0.5 * k;
      end.confining_stress_Pa = 9e9;  // a mean takes its place
      close_row(r, end);
    }
  return r;
}

}  // namespace

TEST_CASE(
    "recorder: a row is the mean of its steps, counts and energies are those at its end [exact means]") {
  const Recorder r = record(2000, 16, 160);
  REQUIRE(r.rows.size() == 10);
  REQUIRE(r.mismatch.size() == 10);
  for (int row = 0; row < 10; ++row) {
    const double mean = 16 * row + 8.5;
    const CurveRow& c = r.rows[std::size_t(row)];
    CHECK(c.time_s == doctest::Approx(1e-3 * mean).epsilon(1e-14));
    CHECK(c.axial_strain == doctest::Approx(1e-5 * mean).epsilon(1e-14));
    CHECK(c.platen_strain == doctest::Approx(2e-5 * mean).epsilon(1e-14));
    CHECK(c.axial_stress_Pa == doctest::Approx(1e6 * mean).epsilon(1e-14));
    CHECK(c.radial_strain == doctest::Approx(-1e-6 * mean).epsilon(1e-14));
    CHECK(c.volumetric_strain == doctest::Approx(4e-6 * mean).epsilon(1e-14));
    CHECK(c.confining_stress_Pa == doctest::Approx(3e4 * mean).epsilon(1e-14));
    CHECK(c.broken_tension == 16 * (row + 1));
    CHECK(c.kinetic_J == 8 * (row + 1));
    CHECK(r.mismatch[std::size_t(row)] == doctest::Approx(7 * mean).epsilon(1e-14));
  }
  CHECK(record(2000, 16, 15).rows.empty());
}

TEST_CASE(
    "recorder: merged rows are the means of twice the steps, there are half to all of the capacity [exact "
    "means]") {
  const Recorder r = record(40, 4, 4 * 40 * 2 + 3 * 16);  // merged twice, then 3 rows of 16
  CHECK(r.steps_per_row == 16);
  REQUIRE(r.rows.size() == 20 + 3);
  for (std::size_t row = 0; row < r.rows.size(); ++row) {
    const double mean = 16.0 * double(row) + 8.5;
    CHECK(r.rows[row].axial_stress_Pa == doctest::Approx(1e6 * mean).epsilon(1e-13));
    CHECK(r.rows[row].volumetric_strain == doctest::Approx(4e-6 * mean).epsilon(1e-13));
    CHECK(r.rows[row].broken_tension == 16 * double(row + 1));
    CHECK(r.rows[row].confining_stress_Pa == doctest::Approx(3e4 * mean).epsilon(1e-13));
    CHECK(r.mismatch[row] == doctest::Approx(7 * mean).epsilon(1e-13));
  }
  for (const int steps : {100, 1000, 10000, 54321}) {
    const Recorder long_run = record(64, 1, steps);
    CHECK(long_run.rows.size() < 64);
    CHECK(long_run.rows.size() >= (steps < 64 ? 0 : 32));
    CHECK(long_run.rows.size() == long_run.mismatch.size());
    // nothing is lost: the means cover all steps but those of the open row
    CHECK(long_run.rows.size() * long_run.steps_per_row + long_run.steps == std::size_t(steps));
  }
}
