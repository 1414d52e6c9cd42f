#include "core/loading/instruments.hpp"

#include <cmath>

namespace breccia {
namespace {

double gauge_now(const World& w, const Gauge& g) {
  return read_gauge(g, w.particles.position, w.particles.reference_position, w.partition, w.options.threads);
}

}  // namespace

Instruments make_instruments(const World& w, const Assembly& a, const LoadTest& test,
                             std::span<const Gid> left_out, const Datum* zeros) {
  Instruments in;
  in.loading = test.loading;
  in.grip = a.grip;
  in.sign = test.loading == Loading::tension ? -1.0 : 1.0;
  in.lateral_directions = a.space == Space::two_d ? 1 : 2;
  if (a.grip == Support::ends) in.axial = axial_gauge(a, left_out);
  if (a.grip != Support::halves && a.grip != Support::vice) in.lateral = lateral_gauge(a, left_out);
  in.zeros = zeros ? *zeros
                   : Datum{gauge_now(w, in.axial), gauge_now(w, in.lateral), approach(w.platens),
                           shear_travel(w.platens)};
  in.free_length = a.length() - 2.0 * a.layer;
  return in;
}

StepReading read(World& w, const Instruments& in) {
  const Lap lap(w.phases, Phase::measure);
  StepReading r;
  r.time = w.time;
  r.confining_stress = w.confinement.acting;
  if (in.loading == Loading::cutting) {
    // the strain is the way over the block's width, stresses are forces over the area of the cut
    const Tool& tool = w.tool;
    r.axial_strain = r.platen_strain = tool.travel / w.body.diameter;
    r.axial_stress = -tool.load.x / tool.area;  // (B120)
    r.confining_stress = tool.load.z / tool.area;
    r.radial_strain = r.volumetric_strain = CurveRow::untracked;
    r.mismatch = std::abs(tool.load.x + w.platens.force[0].x) / tool.area;
    return r;
  }
  if (in.loading == Loading::shear) {
    // of a shear box: the strain is the shift over its width, the stress is that of the band
    r.axial_strain = r.platen_strain = (shear_travel(w.platens) - in.zeros.shear) / w.body.diameter;
    r.axial_stress = shear_stress(w.platens);  // (B80)
    r.confining_stress = axial_stress(w.platens);
    r.radial_strain = CurveRow::untracked;
    r.volumetric_strain = (approach(w.platens) - in.zeros.approach) / w.body.height;  // dilation is negative
    r.mismatch = mismatch(w.platens);
    return r;
  }
  r.platen_strain = in.sign * (approach(w.platens) - in.zeros.approach) / in.free_length;  // (B77)
  r.axial_strain = in.axial.rows.empty() ? r.platen_strain : in.sign * (w.watch.axial() - in.zeros.axial);
  r.radial_strain =
      in.lateral.rows.empty() ? CurveRow::untracked : in.sign * (w.watch.lateral() - in.zeros.lateral);
  r.axial_stress = in.sign * axial_stress(w.platens);
  // across a disc strains are not uniform: no volume follows from them (B79)
  r.volumetric_strain = in.grip == Support::strips ? CurveRow::untracked
                                                   : r.axial_strain + in.lateral_directions * r.radial_strain;
  r.mismatch = mismatch(w.platens);
  return r;
}

double travel(const World& w, const Instruments& in) {
  if (in.loading == Loading::cutting) return w.tool.travel;
  return in.loading == Loading::shear ? shear_travel(w.platens) - in.zeros.shear
                                      : in.sign * (approach(w.platens) - in.zeros.approach);
}

}  // namespace breccia
