#include "io/cases/check_case.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "core/bonding/several_materials.hpp"
#include "io/cases/keys_material.hpp"
#include "io/cases/keys_write.hpp"
#include "io/text/suggest.hpp"

namespace breccia {
namespace {

/// What one key says about another. Places are those of the keys.
struct Checks : CaseLaid {
  std::string place(std::string_view name) const {
    const auto given = layer.find(name);
    return given == layer.end() || given->second.place.empty() ? file : given->second.place;
  }
  bool has(std::string_view name) const { return layer.contains(name); }
  [[noreturn]] void no(std::string_view name, const std::string& text) const {
    refuse(place(name), name, text);
  }

  bool is_across() const { return test && test->across; }
  /// Where a case of the other dimension is run.
  std::string elsewhere(std::string_view dimensions) const {
    return test->other_space.empty() ? ""
                                     : fmt::format(" (in {}: breccia-{})", dimensions, test->other_space);
  }

  void specimen() const {
    if (!c.specimen.file && !c.specimen.pack)
      no(!test ? "specimen.pack" : "specimen.file",
         !test ? "missing; write [specimen.pack] with spheres = N"
               : "missing; name a .csv or .mdpa file, or write [specimen.pack]");
    body();
    // guessed wrongly, a disc is pressed along its own axis
    const auto axis = layer.find("specimen.axis");
    if (is_across() && c.specimen.file && (axis == layer.end() || axis->second.place.empty()))
      no("specimen.axis",
         "missing; a Brazilian test must know the axis of the disc in the file: \"x\", \"y\" or \"z\"");
    if (c.specimen.file) return;
    if (has("specimen.sha256")) no("specimen.sha256", "belongs to specimen.file; leave it out");
    packing();
  }

  void body() const {
    const Body& body = c.specimen.body;
    const bool box = body.shape == Shape::box, disc = body.shape == Shape::disc;
    hole();
    if (c.specimen.space == Space::two_d) return body_in_plane();
    if (!has("specimen.diameter")) no("specimen.diameter", "missing; give the nominal diameter, \"150 mm\"");
    if (!has("specimen.height"))
      no("specimen.height", "missing; give the nominal height along the axis, \"300 mm\"");
    if (box && !has("specimen.depth"))
      no("specimen.depth", "missing; a box has its width along x as diameter, and a depth");
    if (!box && has("specimen.depth")) no("specimen.depth", "belongs to shape = \"box\"; leave it out");
    if (is_across() && !disc) no("specimen.shape", "a Brazilian test presses a disc; valid: \"disc\"");
    if (test && !test->three_d)
      no("specimen.dimensions", fmt::format("a {} test has two; valid: 2{}", test->name, elsewhere("three")));
    if (!test || is_across()) return;
    const bool boxes = test->box, cylinders = test->cylinder;
    if (disc || (box && !boxes) || (!disc && !box && !cylinders)) {
      const std::string text = fmt::format("{}: specimen.shape \"{}\" does not go with breccia-{}; valid: {}",
                                           place("specimen.shape"),
                                           disc  ? "disc"
                                           : box ? "box"
                                                 : "cylinder",
                                           test->name,
                                           !cylinders ? "\"box\""
                                           : boxes    ? "\"cylinder\", \"box\""
                                                      : "\"cylinder\"");
      throw BadInput(text);
    }
  }

  void hole() const {
    const Body& body = c.specimen.body;
    if (!(body.hole > 0.0)) return;
    const auto length = [](double value) { return format_quantity(value, dimension::length); };
    if (c.specimen.space == Space::two_d) no("specimen.hole", "a 2-D scene has no axis; leave it out");
    if (body.shape == Shape::disc) no("specimen.hole", "belongs to a cylinder or a box; leave it out");
    const double width = body.shape == Shape::box ? std::min(body.diameter, body.depth) : body.diameter;
    if (body.hole > 0.8 * width)
      no("specimen.hole", fmt::format("{} leaves a wall of less than a tenth of the width, {}",
                                      length(body.hole), length(width)));
  }

  void body_in_plane() const {
    const Shape shape = c.specimen.body.shape;
    if (test && !test->two_d)
      no("specimen.dimensions",
         fmt::format("breccia-{} has three; valid: 3{}", test->name, elsewhere("two")));
    if (shape == Shape::cylinder)
      no("specimen.shape", "a 2-D scene has no cylinder; valid: \"box\" (a rectangle), \"disc\" (a circle)");
    if (is_across() && shape != Shape::disc)
      no("specimen.shape", "a Brazilian test presses a disc; valid: \"disc\"");
    if (!has("specimen.diameter"))
      no("specimen.diameter",
         "missing; give the diameter of the circle or the width of the rectangle, \"50 mm\"");
    if (shape == Shape::box && !has("specimen.height"))
      no("specimen.height", "missing; give the height of the rectangle, \"100 mm\"");
    if (shape == Shape::disc && test && !is_across())
      no("specimen.shape", fmt::format("breccia-{} presses a rectangle; valid: \"box\"", test->name));
    if (shape == Shape::disc && has("specimen.height"))
      no("specimen.height", "a disc in a 2-D scene is 1 m thick; leave it out");
    if (has("specimen.depth")) no("specimen.depth", "a 2-D scene is 1 m thick; leave it out");
  }

  void packing() const {
    if (has("specimen.pack.genesis_pressure") && c.specimen.space != Space::two_d)
      no("specimen.pack.genesis_pressure",
         "presses discs in a plane; write specimen.dimensions = 2 or leave it out");
    if (c.specimen.axis != 'z') no("specimen.axis", "a packing made here has its axis along z; valid: \"z\"");
    if (c.specimen.centre) no("specimen.centre", "belongs to specimen.file; a packing made here is centred");
    if (!has("specimen.pack.spheres") && c.specimen.pack->sizes.kind != SizeDistribution::Kind::sieves)
      no("specimen.pack.spheres", "missing; give the number of spheres");
    const SizeDistribution& sizes = c.specimen.pack->sizes;
    const bool sieves = sizes.kind == SizeDistribution::Kind::sieves;
    const std::string_view spread = "specimen.pack.sizes.spread", openings = "specimen.pack.sizes.openings",
                           passing = "specimen.pack.sizes.passing", finest = "specimen.pack.sizes.finest";
    if (sieves && has(spread)) no(spread, "belongs to kind \"lognormal\" or \"uniform\"; leave it out");
    for (const auto name : {openings, passing}) {
      if (sieves && !has(name)) no(name, "missing; kind \"sieves\" has openings and passing");
      if (!sieves && has(name)) no(name, "belongs to kind = \"sieves\"; leave it out");
    }
    if (!sieves && has(finest)) no(finest, "belongs to kind = \"sieves\"; leave it out");
    if (!sieves) return;
    if (has("specimen.pack.genesis_pressure"))
      no("specimen.pack.genesis_pressure",
         "makes the discs grow, and sieves are lengths; give specimen.pack.porosity instead");
    if (sizes.sieve_openings.size() != sizes.sieve_passing.size() || sizes.sieve_openings.size() < 2)
      no(passing, fmt::format("{} values for {} openings; give as many of both, two or more",
                              sizes.sieve_passing.size(), sizes.sieve_openings.size()));
    for (std::size_t i = 1; i < sizes.sieve_openings.size(); ++i)
      if (!(sizes.sieve_openings[i] > sizes.sieve_openings[i - 1]))
        no(openings, "two openings are equal; join them");
    if (sizes.sieve_passing.back() != 1)
      no(passing,
         fmt::format("must end with 1, not {}: all passes the last sieve", sizes.sieve_passing.back()));
  }

  void loading() const {
    if (test->pressure == PressureRole::needed) {
      if (!has("test.confinement"))
        no("test.confinement", test->loading == Loading::shear
                                   ? "missing; give the normal stresses on the lid, [\"1 MPa\", \"5 MPa\"]"
                                   : "missing; give the pressure to reach, [\"650 MPa\"]");
      for (double p : c.test.confinement)
        if (!(p > 0)) no("test.confinement", "must be more than 0 Pa");
    }
    for (std::size_t k = 1; k < c.test.confinement.size(); ++k)
      for (std::size_t j = 0; j < k; ++j)
        if (same_confinement(c.test.confinement[j], c.test.confinement[k]))
          no("test.confinement", fmt::format("{} stands twice; leave one out",
                                             format_quantity(c.test.confinement[k], dimension::stress)));
    for (double strain : c.test.unload_at)
      if (strain > c.test.stop_strain)
        no("test.unload_at", fmt::format("{:g} lies beyond test.stop_strain {:g}: the run ends before; raise "
                                         "test.stop_strain or leave it out",
                                         strain, c.test.stop_strain));
    if (c.test.load_axis == c.specimen.axis)
      no("test.load_axis", "is the disc's own axis (specimen.axis); a disc is pressed across it");
    if (test->pressure != PressureRole::must_be_zero) return;
    for (double p : c.test.confinement)
      if (p != 0)
        no("test.confinement",
           fmt::format("{}: an unconfined test has none; leave it out, or use breccia-triaxial",
                       format_quantity(p, dimension::stress)));
  }

  void intermediate() const {
    if (c.specimen.body.shape == Shape::box && c.specimen.space == Space::three_d && !test->two_d)
      idle("test.skin_weights", false, "the faces of a box share their areas as pi r^2");
    const auto& stress = c.test.intermediate_stress;
    if (stress.empty()) return;
    const auto text = [](double p) { return format_quantity(p, dimension::stress); };
    if (c.specimen.body.shape != Shape::box)
      no("test.intermediate_stress",
         "acts on two faces of a box; write specimen.shape = \"box\" or leave it out");
    if (stress.size() != 1 && stress.size() != c.test.confinement.size())
      no("test.intermediate_stress",
         fmt::format("has {} values where test.confinement has {}; give one, or as many", stress.size(),
                     c.test.confinement.size()));
    for (std::size_t k = 0; k < c.test.confinement.size(); ++k) {
      const double other = stress[std::min(k, stress.size() - 1)], least = c.test.confinement[k];
      if (!(least > 0.0))
        no("test.intermediate_stress",
           "needs a test.confinement above 0 Pa beside it, the smallest of the three stresses");
      if (other < least)
        no("test.intermediate_stress",
           fmt::format("{} is below the confinement {}: it is the larger of the two", text(other),
                       text(least)));
    }
  }

  void tool() const {
    if (test->loading != Loading::cutting) return;
    const Body& body = c.specimen.body;
    const auto length = [](double value) { return format_quantity(value, dimension::length); };
    if (!c.test.cut_depth) no("test.cut_depth", "missing; give how deep the tool cuts, \"5 mm\"");
    if (*c.test.cut_depth > 0.5 * body.height)
      no("test.cut_depth", fmt::format("{} is more than half the block's height, {}",
                                       length(*c.test.cut_depth), length(body.height)));
    if (c.test.cut_width && *c.test.cut_width > body.depth)
      no("test.cut_width",
         fmt::format("{} is more than the block's depth, {}; leave it out for a tool across all of it",
                     length(*c.test.cut_width), length(body.depth)));
    if (c.test.rake_angle + c.test.clearance_angle > 80)
      no("test.rake_angle",
         fmt::format("{:g} and test.clearance_angle {:g} leave a tool of less than 10 degrees",
                     c.test.rake_angle, c.test.clearance_angle));
  }

  void strips() const {
    if (!is_across()) return;
    const double radius = 0.5 * c.specimen.body.diameter;
    const auto length = [](double value) { return format_quantity(value, dimension::length); };
    if (c.test.strip_width && *c.test.strip_width > 0.5 * c.specimen.body.diameter)
      no("test.strip_width", fmt::format("{} is more than half the disc's diameter, {}; a strip is narrow",
                                         length(*c.test.strip_width), length(2 * radius)));
    if (c.test.strip_depth && c.test.plane_strips)
      no("test.strip_depth", "planes hold no spheres; leave it out, or write test.strips = \"layers\"");
    if (c.test.strip_depth && *c.test.strip_depth > 0.5 * radius)
      no("test.strip_depth", fmt::format("{} is more than half the disc's radius, {}; a strip is thin",
                                         length(*c.test.strip_depth), length(radius)));
    if (c.test.plane_strips && c.test.rough_platens)
      no("test.platens", "planes hold nothing sideways; write \"smooth\" or leave it out");
  }

  /// A key that is given and that nothing reads; with its default it does no harm.
  void idle(std::string_view name, bool is_used, std::string_view because) const {
    const auto given = layer.find(name);
    if (is_used || given == layer.end() || given->second.place.empty()) return;
    const Key& key = *find_key(name);
    const std::string_view default_text = defaults.of(key).value;
    if (!default_text.empty() &&
        write_value(key, given->second.reading) == write_value(key, read_default_text(key, default_text)))
      return;
    no(name, fmt::format("{}; leave it out", because));
  }

  /// A request that cannot happen, because what it belongs to is not there.
  void idle_keys() const {
    const auto presses = [](double p) { return p > 0; };
    const bool pressed = std::any_of(c.test.confinement.begin(), c.test.confinement.end(), presses);
    idle("test.unload_to", !c.test.unload_at.empty(), "without test.unload_at nothing is unloaded");
    idle("test.load_axis", c.specimen.space != Space::two_d, "in 2-D a disc is pressed along specimen.axis");
    idle("time.mass_factor", c.mass_scaling, "without time.mass_scaling = true no sphere is made heavier");
    idle("damping.form", c.damping.contact > 0, "with damping.contact = 0 there is no dashpot");
    idle("damping.scheme", c.damping.contact > 0, "with damping.contact = 0 there is no dashpot");
    idle("damping.rotation", c.features.rotation, "with features.rotation = false nothing spins");
    idle("damping.rotation", !c.damping.viscous_rate, "damping.viscous_rate brakes spins too");
    idle("run.search_every", c.features.new_contacts,
         "with features.new_contacts = false nothing is searched for");
    idle("output.orientation", c.frames > 0, "with output.frames = 0 there is no picture to hold it");
    idle("output.orientation", c.features.rotation, "with features.rotation = false nothing spins");
    idle("test.surface", pressed, "without a confinement nothing presses on the lateral surface");
    idle("output.stress", c.frames > 0, "with output.frames = 0 there is no picture to hold it");
    idle("test.hydrostatic_branch", pressed, "without a confinement there is no stage 1");
    idle("test.hydrostatic_branch", c.features.plasticity, "with features.plasticity = false nothing yields");
    idle("test.skin_weights", pressed, "without a confinement nothing presses on the lateral surface");
  }

  /// Ranges that another key makes narrower.
  void narrower_ranges() const {
    for (const Key& key : all_keys()) {
      const auto given = layer.find(key.name), other = layer.find(key.where.key);
      if (key.where.key.empty() || given == layer.end() || other == layer.end()) continue;
      const Reading& value = other->second.reading;
      if ((value.word.empty() ? fmt::format("{}", value.whole) : value.word) != key.where.value) continue;
      check_range(key, given->second.reading, key.where.range, place(key.name),
                  fmt::format(" ({} {})", key.where.key, key.where.value));
    }
  }

  void law(const std::string& name, const std::string& where) const {
    const LawFacts& facts = facts_of(name);
    const bool elastic = c.test.hydrostatic_branch == HydrostaticResponse::elastic;
    if (elastic && has("test.hydrostatic_branch") && facts.plasticity && !facts.has("limits"))
      no("test.hydrostatic_branch",
         fmt::format("law {} has no limits to raise: it hardens from stage 1 on; valid: \"law\"",
                     quote(name)));
    if (elastic && !facts.plasticity)
      idle("test.hydrostatic_branch", false, fmt::format("law {} never yields", quote(name)));
    const bool of_bonds = facts_of(name).has("normal_stiffness");
    if (of_bonds && c.bonds.alpha_rule != AlphaRule::number)
      no("bonds.alpha",
         fmt::format("law {} has stiffnesses of its own, no area to scale; leave it out", quote(name)));
    if (of_bonds && c.specimen.space != Space::two_d)
      refuse(where, "material.law",
             fmt::format("law {} is one of discs; set specimen.dimensions = 2", quote(name)));
  }

  /// A [[material.at]] that no run uses is a slip of the pen, unless --set has chosen other
  /// confinements.
  /// @param used  confinements of the table that runs take their values from
  void confinements(const std::vector<ConfinementLayer>& groups, const std::vector<double>& used) const {
    if (const Key* key = find_key("test.confinement"); !accepts(*key, test->name) && !groups.empty())
      refuse(groups.front().place, "material.at", fmt::format("{}; leave it out", key->reason));
    if (place("test.confinement") == "--set") return;
    std::string list;
    for (double p : c.test.confinement)
      list += (list.empty() ? "" : ", ") + format_quantity(p, dimension::stress);
    for (const ConfinementLayer& group : groups) {
      const bool is_used = std::any_of(used.begin(), used.end(),
                                       [&](double p) { return same_confinement(p, group.confinement); });
      if (!is_used)
        refuse(group.place, "material.at",
               fmt::format("no run has confinement {}; test.confinement has: {}",
                           format_quantity(group.confinement, dimension::stress), list));
    }
  }
};

}  // namespace

void check_specimen(const CaseLaid& laid) { Checks{laid}.specimen(); }

void check_ranges(const CaseLaid& laid) { Checks{laid}.narrower_ranges(); }

void check_test(const CaseLaid& laid) {
  const Checks checks{laid};
  checks.loading();
  checks.strips();
  checks.tool();
  checks.intermediate();
  checks.idle_keys();
}

void check_confinements(const CaseLaid& laid, const std::vector<ConfinementLayer>& groups,
                        const std::vector<double>& used) {
  Checks{laid}.confinements(groups, used);
}

void check_law(const CaseLaid& laid, const Given& law) { Checks{laid}.law(law.reading.word, law.place); }

void check_groups(const CaseLaid& laid) {
  const Case& c = laid.c;
  for (const GroupCase& group : c.groups) {
    std::vector<const Material*> before{&c.materials.front()};
    for (const GroupCase& other : c.groups) before.push_back(&other.materials.front());
    for (const Material* other : before)
      if (const std::string_view key = unmatched(*other, group.materials.front()); !key.empty())
        refuse(group.place, "material.group",
               fmt::format("{} stands at one of two materials, and something else in its place at the other: "
                           "bonds between them have no mean of the two; give the same one at both",
                           key));
  }
}

}  // namespace breccia
