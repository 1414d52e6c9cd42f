// What is asked of a laboratory test: its loading, and how far it goes.
#pragma once
#include <vector>

#include "core/base/scene_options.hpp"

namespace breccia {

/// compression: platens towards each other. tension: apart. shear: the halves of a shear box along
/// x, under `confinement` on its lid. hydrostatic: pressure alone, up to `confinement`. cutting: a
/// tool moves along x through the top of a block.
enum class Loading { compression, tension, shear, hydrostatic, cutting };

struct LoadTest {
  Loading loading = Loading::compression;
  double confinement = 0;   ///< Pa
  double intermediate = 0;  ///< Pa, on the faces of a box normal to x; 0: the confinement
  HydrostaticResponse hydrostatic_response = HydrostaticResponse::law;
  double limits_raised = 0;   ///< Pa, of the bonds by that
  double platen_speed = 0.1;  ///< m/s, of each platen
  double stop_strain = 0.02;  ///< platen travel over length since the end of stage 1
  double stop_after_peak =
      0.5;          ///< ends when the deviator has fallen by this fraction of its peak; 0 = never
  int frames = 20;  ///< pictures of the state over the whole strain, and one at the end; 0 = none
  std::vector<double> unload_at;  ///< platen strains at which the specimen is unloaded, then loaded again
  double unload_to = 0.1;         ///< fraction of the deviator at which loading begins again
};

/// Pa, that platens begin stage 2 from: the larger of the two that are held.
inline double axial_start(const LoadTest& test) {
  return test.intermediate > 0.0 ? test.intermediate : test.confinement;
}

/// Readings of gauges and platens when loading began.
struct Datum {
  double axial = 0, lateral = 0;   ///< strains
  double approach = 0, shear = 0;  ///< m
};

}  // namespace breccia
