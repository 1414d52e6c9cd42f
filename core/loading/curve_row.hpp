// One row of the curve of a test: what the laboratory's instruments would read, and the energies.
#pragma once
#include <limits>

namespace breccia {

/// The mean over the steps since the row before. Field names are the columns of curve-K.csv, with
/// their units. A quantity that the scene does not track is NaN and is written as an empty field.
struct CurveRow {
  static constexpr double untracked = std::numeric_limits<double>::quiet_NaN();

  double time_s = 0;
  double axial_strain = 0;     ///< gauge: slope of the displacements in the middle half
  double platen_strain = 0;    ///< platen travel over the free height
  double axial_stress_Pa = 0;  ///< total, mean of the two platen reactions over the initial area
  double radial_strain = untracked;
  double volumetric_strain = untracked;
  double confining_stress_Pa = 0;  ///< the pressure applied, or the mean lateral reaction
  double broken_tension = 0;       ///< bonds broken in tension so far
  double broken_shear = 0;         ///< bonds broken in shear so far
  double kinetic_J = untracked;
  double stored_J = untracked;
  double dissipated_J = untracked;
  double work_J = untracked;
};

}  // namespace breccia
