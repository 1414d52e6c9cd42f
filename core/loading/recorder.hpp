// The rows of a curve: sums over steps, turned into means when a row is full. Rows are merged in
// pairs when they become many, so that a run of any length has between half of `capacity` and
// `capacity` rows.
#pragma once
#include <vector>

#include "core/loading/curve_row.hpp"

namespace breccia {

/// What is read at every step.
struct StepReading {
  double time = 0, axial_strain = 0, platen_strain = 0, axial_stress = 0, confining_stress = 0,
         radial_strain = 0, volumetric_strain = 0, mismatch = 0;
};

struct Recorder {
  std::size_t capacity = 1100;
  std::size_t steps_per_row = 4;
  std::vector<CurveRow> rows;
  std::vector<double> mismatch;  ///< Pa, per row

  StepReading sum;
  std::size_t steps = 0;  ///< in `sum`
};

/// Adds a step; true when a row is due.
bool add_reading(Recorder& recorder, const StepReading& reading);

/// Closes the row: means of the readings, and what is known at its end (broken bonds, energies)
/// from `end`.
const CurveRow& close_row(Recorder& recorder, CurveRow end);

}  // namespace breccia
