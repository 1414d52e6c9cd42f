#include "io/ready_specimen.hpp"

#include <fmt/format.h>

#include "io/read_specimen.hpp"

namespace breccia {

Specimen make_specimen(const Case& c, Progress& progress) {
  const SpecimenCase& s = c.specimen;
  if (s.pack) {
    say(progress,
        fmt::format("packing {} {}", s.pack->spheres, s.space == Space::plane ? "discs" : "spheres"));
    return pack_spheres(s.body, *s.pack);
  }
  Specimen specimen = place_specimen(read_specimen(*s.file), s.axis, s.centre, s.space);
  check_specimen(specimen, s.body, s.space);
  return specimen;
}

Features asked_features(const Case& c) {
  Features f;
  f.rotation = c.features.rotation;
  f.plasticity = c.features.plasticity;
  f.breakage = c.features.breakage;
  f.contact_damping = c.damping.contact > 0.0;
  f.criterion = c.materials.front().criterion;
  return f;
}

Assembly make_assembly(const Case& c, const Features& features, int threads, Progress& progress) {
  const BondingRule rule{c.bonds.range, c.bonds.coordination};
  Assembly a = assemble(make_specimen(c, progress), c.specimen.body, rule, features, threads);
  say(progress,
      fmt::format("{} spheres, mean radius {:.4g} mm; {} bonds within a range of {:.3g}, {:.2f} per sphere{}",
                  a.particles.size, a.mean_radius * 1e3, a.bonds.size, a.range, a.coordination,
                  a.short_bonds ? fmt::format(", {} of nested spheres", a.short_bonds) : ""));
  return a;
}

}  // namespace breccia
