#include "io/cases/case.hpp"

#include <algorithm>
#include <array>

#include "core/base/error.hpp"
#include "io/cases/accuracy.hpp"
#include "io/cases/keys_material.hpp"
#include "io/cases/keys_write.hpp"
#include "io/cases/material_table.hpp"
#include "io/files/digest.hpp"
#include "io/specimens/read_specimen.hpp"
#include "io/text/input_file.hpp"
#include "io/text/message_line.hpp"
#include "io/text/suggest.hpp"

namespace breccia {
namespace {

bool is_material(std::string_view name) { return name.starts_with("material."); }
bool is_pack(std::string_view name) { return name.starts_with("specimen.pack."); }

bool gives_pack(const Layer& layer) {
  return std::any_of(layer.begin(), layer.end(), [](const auto& entry) { return is_pack(entry.first); });
}

/// Takes the material's keys, or all others, out of a layer.
Layer part_of(const Layer& layer, bool material) {
  Layer part;
  for (const auto& [name, given] : layer)
    if ((is_material(name) && name != "material.preset") == material) part.emplace(name, given);
  return part;
}

/// Whether a key that was not given takes its default in this case.
bool takes_standard(const Key& key, const Layer& layer, const std::string& test) {
  if (layer.contains(key.name) || is_material(key.name) || default_text_of(key, test).empty()) return false;
  if (!accepts(key, test) || (test == "pack" && !key.name.starts_with("specimen."))) return false;
  const Key* other = rival(key);
  if (other && layer.contains(other->name)) return false;
  if (!is_pack(key.name)) return true;
  if (key.name == "specimen.pack.porosity" && layer.contains("specimen.pack.genesis_pressure")) return false;
  if (key.name == "specimen.pack.sizes.spread") {
    const auto kind = layer.find("specimen.pack.sizes.kind");
    if (kind != layer.end() && kind->second.reading.word == "sieves") return false;
  }
  return gives_pack(layer);
}

/// The default that a case takes: its law's, its recipe's, its test's, its dimension's, or
/// everybody's.
struct Standard {
  std::string_view value, of;  ///< of: whose, where it is not everybody's
};

struct Standards {
  std::string_view test;
  Space space = Space::three_d;
  std::string_view law, accuracy;

  Standard of(const Key& key) const {
    for (const RecipeDefault& default_text : accuracy_recipe(accuracy))
      if (default_text.key == key.name) return {default_text.value, "time.accuracy"};
    for (const LawDefault& default_text : facts_of(law).defaults)
      if (default_text.key == key.name) return {default_text.value, "material.law"};
    for (const LawParameter& own : facts_of(law).own)
      if (key.name == fmt::format("material.{}", own.key)) return {own.default_text, "material.law"};
    const std::string_view value = default_text_of(key, test, space);
    if (value == key.default_text) return {value, ""};
    return {value, default_text_of(key, test) == value ? "this test" : "specimen.dimensions"};
  }
};

/// Defaults that a reader of everybody's would not expect, one a line.
std::vector<std::string> unusual_defaults(const Layer& layer, const Layer& material,
                                          const Standards& defaults) {
  std::vector<std::string> lines;
  for (const Key& key : all_keys()) {
    const Layer& of = is_material(key.name) ? material : layer;
    const auto taken = of.find(key.name);
    if (taken == of.end() || !taken->second.place.empty()) continue;
    const Standard standard = defaults.of(key);
    if (standard.of.empty()) continue;
    const std::string value = write_value(key, taken->second.reading);
    lines.push_back(key.law.empty() ? fmt::format("{} = {} ({}; otherwise {})", key.name, value, standard.of,
                                                  key.default_text)
                                    : fmt::format("{} = {} ({})", key.name, value, standard.of));
  }
  return lines;
}

/// Cross-checks: what one key says about another. Places are those of the keys.
struct Checks {
  const Layer& layer;
  const Case& c;
  const std::string& test;
  std::string file;
  Standards defaults;

  std::string place(std::string_view name) const {
    const auto given = layer.find(name);
    return given == layer.end() || given->second.place.empty() ? file : given->second.place;
  }
  bool has(std::string_view name) const { return layer.contains(name); }
  [[noreturn]] void no(std::string_view name, const std::string& text) const {
    refuse(place(name), name, text);
  }

  void specimen() const {
    if (!c.specimen.file && !c.specimen.pack)
      no(test == "pack" ? "specimen.pack" : "specimen.file",
         test == "pack" ? "missing; write [specimen.pack] with spheres = N"
                        : "missing; name a .csv or .mdpa file, or write [specimen.pack]");
    body();
    // guessed wrongly, a disc is pressed along its own axis
    const auto axis = layer.find("specimen.axis");
    if (test == "bts" && c.specimen.file && (axis == layer.end() || axis->second.place.empty()))
      no("specimen.axis",
         "missing; a Brazilian test must know the axis of the disc in the file: \"x\", \"y\" or \"z\"");
    if (c.specimen.file) return;
    if (has("specimen.sha256")) no("specimen.sha256", "belongs to specimen.file; leave it out");
    packing();
  }

  void body() const {
    const Body& body = c.specimen.body;
    const bool box = body.shape == Shape::box, disc = body.shape == Shape::disc;
    if (c.specimen.space == Space::two_d) return body_in_plane();
    if (!has("specimen.diameter")) no("specimen.diameter", "missing; give the nominal diameter, \"150 mm\"");
    if (!has("specimen.height"))
      no("specimen.height", "missing; give the nominal height along the axis, \"300 mm\"");
    if (box && !has("specimen.depth"))
      no("specimen.depth", "missing; a box has its width along x as diameter, and a depth");
    if (!box && has("specimen.depth")) no("specimen.depth", "belongs to shape = \"box\"; leave it out");
    if (test == "bts" && !disc) no("specimen.shape", "a Brazilian test presses a disc; valid: \"disc\"");
    if (test == "biaxial")
      no("specimen.dimensions", "a biaxial test has two; valid: 2 (in three: breccia-triaxial)");
    if (test == "pack" || test == "bts") return;
    const bool boxes = test == "ucs" || test == "tension" || test == "shear";
    if (disc || (box && !boxes)) {
      const std::string text = fmt::format("{}: specimen.shape \"{}\" does not go with breccia-{}; valid: {}",
                                           place("specimen.shape"),
                                           disc  ? "disc"
                                           : box ? "box"
                                                 : "cylinder",
                                           test, boxes ? "\"cylinder\", \"box\"" : "\"cylinder\"");
      throw BadInput(text);
    }
  }

  void body_in_plane() const {
    const Shape shape = c.specimen.body.shape;
    if (test == "triaxial" || test == "usc" || test == "hydrostatic" || test == "shear")
      no("specimen.dimensions", fmt::format("breccia-{} has three; valid: 3{}", test,
                                            test == "triaxial" ? " (in two: breccia-biaxial)" : ""));
    if (shape == Shape::cylinder)
      no("specimen.shape", "a 2-D scene has no cylinder; valid: \"box\" (a rectangle), \"disc\" (a circle)");
    if (test == "bts" && shape != Shape::disc)
      no("specimen.shape", "a Brazilian test presses a disc; valid: \"disc\"");
    if (!has("specimen.diameter"))
      no("specimen.diameter",
         "missing; give the diameter of the circle or the width of the rectangle, \"50 mm\"");
    if (shape == Shape::box && !has("specimen.height"))
      no("specimen.height", "missing; give the height of the rectangle, \"100 mm\"");
    if (shape == Shape::disc && test != "bts" && test != "pack")
      no("specimen.shape", fmt::format("breccia-{} presses a rectangle; valid: \"box\"", test));
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
    if (test == "hydrostatic" || test == "shear") {
      if (!has("test.confinement"))
        no("test.confinement", test == "shear"
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
    if (test != "ucs") return;
    for (double p : c.test.confinement)
      if (p != 0)
        no("test.confinement",
           fmt::format("{}: an unconfined test has none; leave it out, or use breccia-triaxial",
                       format_quantity(p, dimension::stress)));
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
    idle("test.unload_to", !c.test.unload_at.empty(), "without test.unload_at nothing is unloaded");
    idle("test.load_axis", c.specimen.space != Space::two_d, "in 2-D a disc is pressed along specimen.axis");
    idle("time.mass_factor", c.mass_scaling, "without time.mass_scaling = true no sphere is made heavier");
    idle("damping.form", c.damping.contact > 0, "with damping.contact = 0 there is no dashpot");
    idle("damping.scheme", c.damping.contact > 0, "with damping.contact = 0 there is no dashpot");
    idle("damping.rotation", c.features.rotation, "with features.rotation = false nothing spins");
    idle("output.stress", c.frames > 0, "with output.frames = 0 there is no picture to hold it");
    const auto presses = [](double p) { return p > 0; };
    idle("test.skin_weights", std::any_of(c.test.confinement.begin(), c.test.confinement.end(), presses),
         "without a confinement nothing presses on the mantle");
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
    if (const Key* key = find_key("test.confinement"); !accepts(*key, test) && !groups.empty())
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

/// The specimen's file stands relative to the case's folder.
std::filesystem::path find_specimen(const std::filesystem::path& case_file, const Given& given) {
  const std::filesystem::path file = (case_file.parent_path() / given.reading.word).lexically_normal();
  try {
    check_specimen_type(file);
  } catch (const BadInput& error) {
    refuse(given.place, "specimen.file", error.what());
  }
  std::error_code ignored;
  if (std::filesystem::exists(file, ignored)) {
    if (const std::string why = why_no_file(file); !why.empty())
      refuse(given.place, "specimen.file", fmt::format("{}: {}", file.string(), why));
    return file;
  }
  const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  const std::string best = nearest(file.filename().string(), names_in(folder, file.extension()));
  refuse(given.place, "specimen.file",
         fmt::format("no file {}{}", quote(file.string()),
                     best.empty() ? "; the path starts at the case's folder"
                                  : "; did you mean " + quote(best) + "?"));
}

/// The resolved case names the file by its whole path, and by its content.
/// @returns the digest of what it holds
std::string resolve_specimen(const std::filesystem::path& file, Layer& layer) {
  Given& given = layer.find("specimen.file")->second;
  const std::string whole = std::filesystem::absolute(file).lexically_normal().string();
  if (!is_utf8(whole))
    refuse(
        given.place, "specimen.file",
        fmt::format("{}: this path is not UTF-8, as a case must be: rename the folder or the file", whole));
  given.reading.word = whole;
  Given& digest = layer["specimen.sha256"];
  const std::string now = sha256_of(file);
  if (!digest.reading.word.empty() && digest.reading.word != now)
    refuse(digest.place, "specimen.sha256",
           fmt::format("{} has changed since; put it back as it was, or leave this line out", file.string()));
  return digest.reading.word = now;
}

}  // namespace

std::string place_of(const Case& c, std::string_view key) {
  const auto at = c.places.find(key);
  return at == c.places.end() ? c.source.string() : at->second;
}

Case load_case(const std::filesystem::path& file, const std::vector<std::string>& sets,
               const std::string& test) {
  Case c;
  c.source = file;
  c.inputs = {file};
  Source from_file = read_case_source(read_toml(file), test);
  const Source from_set = read_set_source(sets, test);
  for (const std::string& table : from_set.tables) erase_below(from_file.layer, table);

  Layer layer = part_of(from_file.layer, false);
  lay_over(layer, part_of(from_set.layer, false));
  if (test == "pack")
    std::erase_if(layer, [](const auto& entry) { return !entry.first.starts_with("specimen."); });
  const auto place_of = [&](std::string_view name) {
    const auto given = layer.find(name);
    return given == layer.end() || given->second.place.empty() ? file.string() : given->second.place;
  };

  // the law comes first: it has defaults of its own
  MaterialLayers layers{{},
                        {},
                        part_of(from_file.layer, true),
                        from_file.at.value_or(std::vector<ConfinementLayer>{}),
                        part_of(from_set.layer, true)};
  if (from_set.at) layers.given_at = *from_set.at;
  if (const auto preset = layer.find("material.preset"); preset != layer.end()) {
    Source source = read_preset(preset->second.reading.word, place_of("material.preset"), file.parent_path());
    c.inputs.push_back(source.file);
    layers.preset = std::move(source.layer);
    if (source.at) layers.preset_at = std::move(*source.at);
  }
  const Layer base = material_base(layers);
  const std::string law = law_of(base);
  Standards defaults{test, Space::three_d, law, ""};
  const auto take = [&](std::string_view name, std::string_view value) {
    const Key& key = *find_key(name);
    if (test != "pack" && accepts(key, test) && !layer.contains(key.name))
      layer[std::string(key.name)] = {read_default_text(key, value), ""};
  };
  for (const LawDefault& default_text : facts_of(law).defaults) take(default_text.key, default_text.value);
  if (const auto accuracy = layer.find("time.accuracy"); accuracy != layer.end())
    defaults.accuracy = accuracy->second.reading.word;
  if (const auto accuracy = layer.find("time.accuracy"); accuracy != layer.end())
    for (const RecipeDefault& default_text : accuracy_recipe(accuracy->second.reading.word))
      take(default_text.key, default_text.value);
  const Key& dimensions = *find_key("specimen.dimensions");
  const auto asked = layer.find(dimensions.name);
  const bool plane =
      (asked == layer.end() ? read_default(dimensions, test) : asked->second.reading).whole == 2;
  if (plane) defaults.space = Space::two_d;
  for (const Key& key : all_keys())
    if (takes_standard(key, layer, test))
      layer[std::string(key.name)] = {read_default(key, test, plane ? Space::two_d : Space::three_d), ""};

  for (const Key& key : all_keys())
    if (const auto given = layer.find(key.name); given != layer.end() && key.store)
      key.store(c, given->second.reading);
  for (const Layer* of : std::array<const Layer*, 2>{&base, &layer})
    for (const auto& [name, given] : *of)
      if (!given.place.empty()) c.places[name] = given.place;
  const Checks checks{layer, c, test, file.string(), defaults};
  checks.specimen();
  checks.narrower_ranges();
  if (plane) {
    if (c.specimen.body.shape == Shape::disc) c.specimen.body.height = c.specimen.body.diameter;
    if (c.specimen.pack) c.specimen.pack->space = Space::two_d;
  }
  if (test != "pack") checks.loading(), checks.idle_keys();
  if (c.specimen.file) {
    c.specimen.file = find_specimen(file, layer.find("specimen.file")->second);
    c.specimen.sha256 = resolve_specimen(*c.specimen.file, layer);
    c.inputs.push_back(*c.specimen.file);
  }
  c.unusual = unusual_defaults(layer, test == "pack" ? Layer{} : base, defaults);
  if (test == "pack") {
    c.resolved = write_case(layer, {}, {}, test);
    return c;
  }

  std::vector<MaterialAt> found;
  std::vector<double> used;
  for (const double confinement : c.test.confinement) {
    found.push_back(material_at(layers, confinement));
    used.insert(used.end(), found.back().used.begin(), found.back().used.end());
  }
  checks.confinements(layers.given_at, used);
  refuse_foreign_keys(layers.given, law);
  refuse_foreign_keys(layers.set, law);
  for (const ConfinementLayer& group : layers.given_at) refuse_foreign_keys(group.layer, law);
  checks.law(law, base.at("material.law").place);
  std::vector<ConfinementLayer> at;
  for (std::size_t k = 0; k < found.size(); ++k) {
    Layer& material = found[k].layer;
    c.materials.push_back(make_material(material, c.features, c.bonds.elasticity, file.string()));
    c.material_notes.push_back(
        {found[k].from, found[k].from.empty() ? "" : describe_varying(layers, material), found[k].warning});
    const std::string from =
        found[k].from.empty() ? "" : fmt::format("the values of the table: {}", found[k].from);
    at.push_back({c.test.confinement[k], std::move(material), from});
  }
  layer.erase("material.preset");  // the resolved case carries the values themselves
  c.resolved = write_case(layer, base, at, test);
  return c;
}

}  // namespace breccia
