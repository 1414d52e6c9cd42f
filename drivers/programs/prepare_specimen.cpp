#include "drivers/programs/prepare_specimen.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "core/base/error.hpp"
#include "core/base/hold.hpp"
#include "core/bonding/law_of_material.hpp"
#include "core/bonding/pieces.hpp"
#include "core/bonding/section_area.hpp"
#include "core/elastic/elastic_network.hpp"
#include "core/packing/drill.hpp"
#include "core/tables/laws.hpp"
#include "core/world/single_precision.hpp"
#include "drivers/programs/check_body.hpp"
#include "drivers/programs/check_bonded.hpp"
#include "drivers/programs/scene_of_case.hpp"
#include "io/cases/keys_material.hpp"
#include "io/specimens/read_specimen.hpp"
#include "kernels/loops/bond_pass.hpp"

namespace breccia {
namespace {

/// What is said of a key from far below gets "file:line" in front.
template <class Work>
auto with_place(const Case& c, const Work& work) {
  try {
    return work();
  } catch (const BadInput& bad) {
    const std::string text = bad.what(), key = text.substr(0, text.find(':'));
    if (find_key(key)) fail<BadInput>("{}: {}", place_of(c, key), text);
    throw;
  }
}

/// Reads a specimen, and puts it in place by the spheres that hang together.
Specimen read_and_place(const Case& c, int threads, Progress& progress, std::vector<std::string>& warnings) {
  const SpecimenCase& s = c.specimen;
  const Specimen as_read = read_specimen(*s.file);
  check_sizes(as_read);
  const MainBody body = main_body(as_read, std::max(c.bonds.range, BondingRule{}.range), threads);
  Specimen placed = place_specimen(as_read, s.axis, s.centre, s.space, body.has);
  check_specimen(placed, s.body, s.space, body.has);
  for (std::string& warning : check_body(c, placed, body, as_read, progress))
    warnings.push_back(std::move(warning));
  return placed;
}

}  // namespace

Specimen make_specimen(const Case& c, int threads, Progress& progress, std::vector<std::string>& warnings) {
  const SpecimenCase& s = c.specimen;
  if (!s.pack) return read_and_place(c, threads, progress, warnings);
  try {
    say(progress, fmt::format("packing {} {}", spheres_of(s.body, *s.pack),
                              s.space == Space::two_d ? "discs" : "spheres"));
    hold_at(HoldPoint::packing);
    return drilled(pack_spheres(s.body, *s.pack), s.body);
  } catch (const BadPacking& bad) {
    const std::string key = "specimen.pack." + bad.key;
    fail<BadInput>("{}: {}: {}", place_of(c, key), key, bad.what());
  }
}

Features asked_features(const Case& c) {
  Features f;
  f.rotation = c.features.rotation;
  f.plasticity = c.features.plasticity && facts_of(c.materials.front().law).plasticity;
  f.breakage = c.features.breakage;
  f.contact_damping = c.damping.contact > 0.0;
  f.criterion = c.materials.front().criterion;
  f.several = !c.groups.empty();
  return f;
}

namespace {

/// Those that will run.
Features features_that_run(const Case& c, const Features& asked) {
  const Material& m = c.materials.front();
  const auto built_in = [&](Precision precision) -> std::optional<Features> {
    try {
      return built_features(law_of(m, paper_shear_ratio(m.poisson_ratio)), asked,
                            {precision, c.features.energy_ledger});
    } catch (const std::invalid_argument&) {
      return std::nullopt;
    }
  };
  if (const auto built = built_in(c.precision)) return *built;
  if (built_in(Precision::full))
    fail<BadInput>(
        "{}: run.precision \"single\" is not built for material.law \"{}\"; take \"double\", or leave "
        "run.precision out",
        place_of(c, "run.precision"), m.law);
  fail<BadInput>("{}: material.law \"{}\" has no criterion \"coupled\"; leave material.criterion out",
                 place_of(c, "material.criterion"), m.law);
}

std::string describe(const Assembly& a, const Connection& connection) {
  return fmt::format(
      "{} {}, mean radius {:.4g} mm; {} bonds within a range of {:.3g}, {:.2f} per {}{}{}{}",
      a.particles.size, a.space == Space::two_d ? "discs" : "spheres", a.mean_radius * 1e3, a.bonds.size,
      a.range, a.coordination, a.space == Space::two_d ? "disc" : "sphere",
      a.short_bonds ? fmt::format(", {} of nested spheres", a.short_bonds) : "",
      a.dropped_bonds ? fmt::format("; {} pairs in range have no common face", a.dropped_bonds) : "",
      describe(connection));
}

AreaFactor area_factor(const Case& c, const Assembly& assembly, AlphaRule rule, bool rough, bool contacts,
                       int threads, Progress& progress) {
  const AreaFactor f = find_area_factor(
      assembly, {rule, c.bonds.alpha, c.bonds.elasticity, c.materials.front(), rough, contacts}, threads);
  const BondLaw law = law_of(c.materials.front(), f.shear_ratio);
  say(progress, fmt::format("alpha {:.4f} (areas tile space {:.3f} times), k_s/k_n {:.4f}{}", f.alpha,
                            f.fabric, shear_ratio_of(law),
                            f.probes ? fmt::format("; elastic probe: E {:.4g} GPa, nu {:.4f}",
                                                   f.young_modulus * 1e-9, f.poisson_ratio)
                                     : ""));
  return f;
}

/// Each [[material.group]] has spheres.
void check_groups(const Case& c, const Specimen& specimen) {
  std::set<int> present;
  for (const SpecimenSphere& s : specimen.spheres) present.insert(s.group);
  for (const GroupCase& group : c.groups)
    if (!present.contains(group.group))
      fail<BadInput>("{}: material.group: {} has no sphere of group {}; it has {}", group.place,
                     specimen.source, group.group, fmt::join(present, ", "));
}

/// The factors that each group's material would have if the specimen were made of it.
std::vector<AreaFactor> factors_of_groups(const Case& c, const Assembly& a, AlphaRule rule, bool rough,
                                          bool contacts, int threads) {
  std::vector<AreaFactor> factors;
  for (const GroupCase& group : c.groups)
    factors.push_back(find_area_factor(
        a, {rule, c.bonds.alpha, c.bonds.elasticity, group.materials.front(), rough, contacts}, threads));
  return factors;
}

std::string describe_materials(const Assembly& a, std::size_t materials) {
  std::vector<std::size_t> spheres(materials, 0);
  for (std::size_t row = 0; row < a.particles.size; ++row) ++spheres[a.particles.material[row]];
  std::size_t across = 0;
  for (std::size_t k = 0; k < a.bonds.size; ++k)
    across += a.particles.material[a.bonds.row_lo[k]] != a.particles.material[a.bonds.row_hi[k]];
  return fmt::format("{} materials, of {} spheres; {} bonds between two of them", materials,
                     fmt::join(spheres, ", "), across);
}

Strips strips_of(const Case& c) {
  Strips strips{c.test.plane_strips, c.test.strip_width, c.test.strip_depth};
  if (c.test.strip_angle)
    strips.width = c.specimen.body.diameter * std::sin(*c.test.strip_angle * std::numbers::pi / 360.0);
  return strips;
}

/// Whether surfaces without a bond press from the start. In tension they part, and Hertz's spring
/// begins with nothing.
bool has_contacts(const Case& c, const LaboratoryTest& test) {
  return c.features.new_contacts && test.loading != Loading::tension &&
         c.materials.front().contact_law == ContactLaw::linear;
}

/// Whether a fluid, a wall or the halves of a shear box act on the lateral surface.
bool acts_sideways(const Case& c, const LaboratoryTest& test) {
  const auto& p = c.test.confinement;
  return test.rigid_sides || test.support == Support::halves ||
         std::any_of(p.begin(), p.end(), [](double pressure) { return pressure > 0.0; });
}

void say_warnings(const std::vector<std::string>& warnings, Progress& progress) {
  for (const std::string& warning : warnings) say(progress, "warning: " + warning);
}

}  // namespace

std::string describe_elasticity(const Case& c, const LaboratoryTest& test, const ReadySpecimen& ready,
                                int threads) {
  Assembly a = ready.assembly;
  if (a.grip != Support::ends) return "";
  const Material& m = c.materials.front();
  const double reach = 0.4 * a.length();  // the levels of the thesis' table 5.1, away from the ends
  const double covered = area_through_levels(a.particles, a.bonds,
                                             std::span(a.bonds.area).first(a.bonds.size), -reach, reach, 41)
                             .mean /
                         a.section();
  for (double& area : a.bonds.area) area *= ready.factor.alpha;
  Touching touching;
  if (has_contacts(c, test)) touching = touching_of(a, m, ready.factor.shear_ratio, threads);
  for (double& stiffness : touching.contacts.stiffness) stiffness *= ready.factor.alpha;
  std::vector<BondMaterial> materials{{m, ready.factor.shear_ratio}};
  for (const BondMaterial& other : materials_of_groups(c, test, 0, ready.factor, ready.group_factors))
    materials.push_back(other);
  std::vector<BondLaw> laws;
  std::vector<double> ratio;
  for_each_pair(materials.size(), [&](std::size_t one, std::size_t other) {
    const BondMaterial of = one == other ? materials[one] : between(materials[one], materials[other]);
    laws.push_back(law_of(of.material, of.shear_ratio));
    ratio.push_back(shear_ratio_of(laws.back()));
  });
  const ElasticResponse e =
      probe(a, bond_stiffness(laws, a.particles, a.bonds), ratio, c.test.rough_platens, threads, touching);
  return fmt::format(
      "specimen: E {:.7g} GPa, nu {:.6f} with k_s/k_n {:.4f}; their areas cover a section {:.4f} times",
      e.young_modulus * 1e-9, e.poisson_ratio, ratio.front(), covered);
}

ReadySpecimen make_ready(const Case& c, const LaboratoryTest& test, const Features& asked, int threads,
                         Progress& progress) {
  const Features features = features_that_run(c, asked);
  BondingRule rule{c.bonds.range,    c.bonds.coordination, c.bonds.area, c.bonds.strength_area,
                   c.specimen.space, Support::ends,        strips_of(c)};
  for (const GroupCase& group : c.groups) rule.materials.push_back(group.group);
  rule.across = c.bonds.between_groups;
  ReadySpecimen ready;
  const Specimen specimen = make_specimen(c, threads, progress, ready.warnings);
  check_groups(c, specimen);
  Body body = c.specimen.body;
  if (c.specimen.space == Space::two_d) {  // one metre thick
    if (body.shape == Shape::box)
      body.depth = 1.0;
    else
      body.height = 1.0;
  }
  const auto bonded = [&](const Specimen& s, const Body& b, Support support) {
    rule.grip = support;
    Assembly a = with_place(c, [&] { return assemble(s, b, rule, features, threads, asked.rotation); });
    a.cement = asked.rotation && facts_of(c.materials.front().law).cement;
    return a;
  };
  const bool contacts = has_contacts(c, test);
  const auto look_at = [&](Assembly& a) {
    ready.connection = leave_out_loose(a, contacts, threads);
    say(progress, describe(a, ready.connection));
    if (!c.groups.empty()) say(progress, describe_materials(a, c.groups.size() + 1));
    check_connection(ready.connection, a, specimen.source, ready.warnings);
    if (const auto k = bond_too_short_for_single(a.bonds); k && c.precision == Precision::single)
      ready.warnings.push_back(fmt::format(
          "bond {}-{}, {:.3g} m long, is shorter than the {:.3g} m that single precision tells: the test "
          "runs in "
          "double",
          a.bonds.gid_lo[*k], a.bonds.gid_hi[*k], a.bonds.rest_length[*k], shortest_told(a.bonds)));
  };
  const auto find_factor = [&](const Assembly& a, AlphaRule alpha, bool rough) {
    ready.factor = area_factor(c, a, alpha, rough, contacts, threads, progress);
    ready.group_factors = factors_of_groups(c, a, alpha, rough, contacts, threads);
    check_area_factor(ready.factor, a, ready.connection, ready.warnings);
  };
  if (!test.across) {
    Assembly ends = bonded(specimen, body, Support::ends);
    look_at(ends);
    check_lateral_surface(ends, acts_sideways(c, test), specimen.source, ready.warnings);
    find_factor(ends, c.bonds.alpha_rule, c.test.rough_platens);
    ready.assembly = std::move(ends);
    if (test.support != Support::ends) {
      ready.assembly = bonded(specimen, body, test.support);
      leave_out_loose(ready.assembly, contacts, threads);
    }
    say_warnings(ready.warnings, progress);
    return ready;
  }
  // a disc is probed along its axis, between its flat faces; a two-dimensional one has none
  Body standing = body;
  standing.on_edge = true;
  AlphaRule alpha = c.bonds.alpha_rule;
  if (c.specimen.space == Space::two_d) {
    ready.assembly = bonded(specimen, standing, Support::strips);
    look_at(ready.assembly);
    if (alpha == AlphaRule::automatic) {
      say(progress, "alpha: a disc in two dimensions has no flat ends to probe; the affine value is used");
      alpha = AlphaRule::affine;
    }
    find_factor(ready.assembly, alpha, false);
  } else {
    ready.assembly =
        bonded(stand_disc(specimen, c.specimen.axis, c.test.load_axis), standing, Support::strips);
    look_at(ready.assembly);
    Assembly lying = bonded(specimen, body, Support::ends);
    leave_out_loose(lying, contacts, threads);
    find_factor(lying, alpha, false);
  }
  say_warnings(ready.warnings, progress);
  return ready;
}

}  // namespace breccia
