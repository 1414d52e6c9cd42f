#include "core/loading/recorder.hpp"

namespace breccia {
namespace {

CurveRow mean_of(const CurveRow& a, const CurveRow& b) {
  CurveRow m = b;  // counts and energies are those at the end
  m.time_s = 0.5 * (a.time_s + b.time_s);
  m.axial_strain = 0.5 * (a.axial_strain + b.axial_strain);
  m.platen_strain = 0.5 * (a.platen_strain + b.platen_strain);
  m.axial_stress_Pa = 0.5 * (a.axial_stress_Pa + b.axial_stress_Pa);
  m.radial_strain = 0.5 * (a.radial_strain + b.radial_strain);
  m.confining_stress_Pa = 0.5 * (a.confining_stress_Pa + b.confining_stress_Pa);
  m.volumetric_strain = 0.5 * (a.volumetric_strain + b.volumetric_strain);
  return m;
}

void merge_pairs(Recorder& r) {
  for (std::size_t k = 0; 2 * k + 1 < r.rows.size(); ++k) {
    r.rows[k] = mean_of(r.rows[2 * k], r.rows[2 * k + 1]);
    r.mismatch[k] = 0.5 * (r.mismatch[2 * k] + r.mismatch[2 * k + 1]);
  }
  r.rows.resize(r.rows.size() / 2);
  r.mismatch.resize(r.rows.size());
  r.steps_per_row *= 2;
}

}  // namespace

bool add_reading(Recorder& r, const Reading& x) {
  r.sum.time += x.time;
  r.sum.axial_strain += x.axial_strain;
  r.sum.platen_strain += x.platen_strain;
  r.sum.axial_stress += x.axial_stress;
  r.sum.confining_stress += x.confining_stress;
  r.sum.radial_strain += x.radial_strain;
  r.sum.volumetric_strain += x.volumetric_strain;
  r.sum.mismatch += x.mismatch;
  return ++r.steps >= r.steps_per_row;
}

const CurveRow& close_row(Recorder& r, CurveRow end) {
  const double one = 1.0 / static_cast<double>(r.steps);
  end.time_s = one * r.sum.time;
  end.axial_strain = one * r.sum.axial_strain;
  end.platen_strain = one * r.sum.platen_strain;
  end.axial_stress_Pa = one * r.sum.axial_stress;
  end.radial_strain = one * r.sum.radial_strain;
  end.confining_stress_Pa = one * r.sum.confining_stress;
  end.volumetric_strain = one * r.sum.volumetric_strain;
  r.mismatch.push_back(one * r.sum.mismatch);
  r.rows.push_back(end);
  r.sum = {};
  r.steps = 0;
  if (r.rows.size() == r.capacity) merge_pairs(r);
  return r.rows.back();
}

}  // namespace breccia
