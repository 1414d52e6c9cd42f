#include "io/cases/case.hpp"

#include <algorithm>
#include <array>

#include "core/base/error.hpp"
#include "io/cases/accuracy.hpp"
#include "io/cases/check_case.hpp"
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

/// Takes the material's keys, or all others, out of a layer.
Layer part_of(const Layer& layer, bool material) {
  Layer part;
  for (const auto& [name, given] : layer)
    if ((is_material(name) && name != "material.preset") == material) part.emplace(name, given);
  return part;
}

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
  const LaboratoryTest* const row = find_laboratory_test(test);
  if (!row) std::erase_if(layer, [](const auto& entry) { return !entry.first.starts_with("specimen."); });
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
    if (row && accepts(key, test) && !layer.contains(key.name))
      layer[std::string(key.name)] = {read_default_text(key, value), ""};
  };
  if (!from_set.groups.empty()) from_file.groups = from_set.groups;
  if (!from_file.groups.empty()) take("bonds.between_groups", "true");
  const auto rolling = base.find("material.rolling_friction");
  defaults.rolls = rolling != base.end() && rolling->second.reading.number > 0.0;
  if (defaults.rolls) take("run.precision", "double");
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
  const CaseLaid laid{layer, c, row, file.string(), defaults};
  check_specimen(laid);
  check_ranges(laid);
  if (plane) {
    if (c.specimen.body.shape == Shape::disc) c.specimen.body.height = c.specimen.body.diameter;
    if (c.specimen.pack) c.specimen.pack->space = Space::two_d;
  }
  if (row) check_test(laid);
  if (c.specimen.file) {
    c.specimen.file = find_specimen(file, layer.find("specimen.file")->second);
    c.specimen.sha256 = resolve_specimen(*c.specimen.file, layer);
    c.inputs.push_back(*c.specimen.file);
  }
  c.unusual = unusual_defaults(layer, row ? base : Layer{}, defaults);
  if (!row) {
    c.resolved = write_case(layer, {}, {}, {}, test);
    return c;
  }

  std::vector<MaterialAt> found;
  std::vector<double> used;
  for (const double confinement : c.test.confinement) {
    found.push_back(material_at(layers, confinement));
    used.insert(used.end(), found.back().used.begin(), found.back().used.end());
  }
  check_confinements(laid, layers.given_at, used);
  refuse_foreign_keys(layers.given, law);
  refuse_foreign_keys(layers.set, law);
  for (const ConfinementLayer& group : layers.given_at) refuse_foreign_keys(group.layer, law);
  check_law(laid, base.at("material.law"));
  if (defaults.rolls) {
    if (!c.features.rotation)
      refuse(rolling->second.place, rolling->first,
             "with features.rotation = false nothing rolls; leave it out");
    if (c.precision == Precision::single)
      refuse(rolling->second.place, rolling->first,
             "resistance to rolling is not built for run.precision = \"single\"; leave one out");
  }
  if (const auto given = base.find("material.contact_law");
      given != base.end() && given->second.reading.word == "hertz-mindlin") {
    if (plane)
      refuse(given->second.place, given->first,
             "Hertz's contact is one of spheres: in two dimensions leave it out");
    if (!c.features.new_contacts)
      refuse(given->second.place, given->first,
             "with features.new_contacts = false no surfaces meet; leave it out");
  }
  for (const char* name :
       {"material.shear_under_yield", "material.unloading_modulus", "material.yield_stress"})
    if (const auto given = base.find(name);
        given != base.end() && !given->second.place.empty() && !c.features.plasticity)
      refuse(given->second.place, given->first,
             "with features.plasticity = false nothing yields; leave it out");
  for (GroupLayer& group : from_file.groups) {
    refuse_foreign_keys(group.layer, law);
    group.layer = layer_of_group(group, law, file.parent_path(), c.inputs);
    c.groups.push_back({group.group, {}, group.place});
  }
  std::vector<ConfinementLayer> at;
  for (std::size_t k = 0; k < found.size(); ++k) {
    Layer& material = found[k].layer;
    for (std::size_t g = 0; g < c.groups.size(); ++g) {
      Layer own = material;
      lay_over(own, from_file.groups[g].layer);
      c.groups[g].materials.push_back(make_material(own, c.features, c.bonds.elasticity, file.string()));
    }
    c.materials.push_back(make_material(material, c.features, c.bonds.elasticity, file.string()));
    c.material_notes.push_back(
        {found[k].from, found[k].from.empty() ? "" : describe_varying(layers, material), found[k].warning});
    const std::string from =
        found[k].from.empty() ? "" : fmt::format("the values of the table: {}", found[k].from);
    at.push_back({c.test.confinement[k], std::move(material), from});
  }
  layer.erase("material.preset");  // the resolved case carries the values themselves
  check_groups(laid);
  c.resolved = write_case(layer, base, at, from_file.groups, test);
  return c;
}

}  // namespace breccia
