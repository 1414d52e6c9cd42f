#include "io/cases/keys_material.hpp"

#include <algorithm>
#include <cstdlib>

#include "core/base/error.hpp"
#include "io/text/input_file.hpp"
#include "io/text/suggest.hpp"
#include "kernels/laws/bond_laws.hpp"

namespace breccia {
namespace {

constexpr std::string_view material_prefix = "material.";

/// A key of some law, but not of this one; density and the like belong to every material.
bool is_foreign(std::string_view name, const LawFacts& facts) {
  const std::string_view key = name.substr(material_prefix.size());
  bool of_a_law = false;
  for_each_law([&]<class Law>(const Law&) { of_a_law = of_a_law || facts_of(Law::name).has(key); });
  return of_a_law && !facts.has(key);
}

std::vector<std::filesystem::path> material_folders(const std::filesystem::path& case_folder) {
  std::vector<std::filesystem::path> folders{case_folder / "materials", case_folder / ".." / "materials"};
  if (const char* data = std::getenv("BRECCIA_DATA"); data && *data)
    folders.push_back(std::filesystem::path(data) / "materials");
  folders.push_back(shipped_data() / "materials");
  return folders;
}

std::vector<std::string> presets_in(const std::vector<std::filesystem::path>& folders) {
  std::vector<std::string> names;
  for (const auto& folder : folders)
    for (const std::string& name : names_in(folder, ".toml"))
      names.push_back(name.substr(0, name.size() - 5));
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

/// Keys of other laws, that a preset may have, leave; what the law has for itself takes its
/// defaults.
void fit_to_law(Layer& material) {
  const LawFacts& facts = facts_of(law_of(material));
  std::erase_if(material, [&](const auto& entry) { return is_foreign(entry.first, facts); });
  for (const LawParameter& own : facts.own) {
    const Key& key = *find_key(std::string("material.") + std::string(own.key));
    if (!own.default_text.empty() && !material.contains(key.name))
      material[std::string(key.name)] = {read_default_text(key, own.default_text), ""};
  }
}

}  // namespace

Layer laid(const MaterialLayers& m, const Layer* preset_at, const Layer* given_at) {
  Layer result = m.preset;
  if (preset_at) lay_over(result, *preset_at);
  lay_over(result, m.given);
  if (given_at) lay_over(result, *given_at);
  lay_over(result, m.set);
  result.erase("material.preset");
  for (const char* name : {"material.law", "material.criterion"})
    if (!result.contains(name)) result[name] = {read_default(*find_key(name), ""), ""};
  fit_to_law(result);
  return result;
}

std::filesystem::path shipped_data() { return BRECCIA_DATA_DIR; }

Source read_preset(const std::string& name, const std::string& place,
                   const std::filesystem::path& case_folder) {
  const auto folders = material_folders(case_folder);
  std::error_code ignored;
  if (name.find('/') == std::string::npos)
    for (const auto& folder : folders) {
      const auto file = (folder / (name + ".toml")).lexically_normal();
      if (!std::filesystem::exists(file, ignored)) continue;
      Source source = read_preset_source(read_toml(file));
      source.file = file;
      return source;
    }
  const auto present = presets_in(folders);
  if (present.empty())
    refuse(place, "material.preset",
           fmt::format("no preset {}: no materials/*.toml found; set BRECCIA_DATA", quote(name)));
  const std::string best = nearest(name, present);
  refuse(place, "material.preset",
         fmt::format("no preset {}; {}valid: {}", quote(name),
                     best.empty() ? "" : "did you mean " + quote(best) + "? ", quote_list(present)));
}

Layer material_base(const MaterialLayers& m) { return laid(m, nullptr, nullptr); }

const LawFacts& facts_of(std::string_view law) {
  static const std::vector<LawFacts> all = [] {
    std::vector<LawFacts> list;
    for_each_law([&]<class Law>(const Law&) {
      LawFacts facts{Law::name, split_words(Law::takes), {}, {}, false};
      for (const LawParameter& own : Law::own) facts.own.push_back(own);
      for (const LawDefault& default_text : Law::defaults) facts.defaults.push_back(default_text);
      facts.cement = passes_moments<Law>;
      for (const Features& set : Law::feature_sets) facts.plasticity = facts.plasticity || set.plasticity;
      list.push_back(std::move(facts));
    });
    return list;
  }();
  for (const LawFacts& facts : all)
    if (facts.name == law) return facts;
  fail<BadInput>("material.law: no law {}", quote(std::string(law)));
}

bool LawFacts::has(std::string_view key) const {
  const auto is_own = [&](const LawParameter& p) { return p.key == key; };
  return std::find(takes.begin(), takes.end(), key) != takes.end() ||
         std::any_of(own.begin(), own.end(), is_own);
}

std::string law_of(const Layer& material) {
  const auto law = material.find("material.law");
  return law == material.end() ? "dempack" : law->second.reading.word;
}

Layer layer_of_group(const GroupLayer& group, const std::string& law,
                     const std::filesystem::path& case_folder, std::vector<std::filesystem::path>& inputs) {
  Layer layer;
  if (const auto preset = group.layer.find("material.preset"); preset != group.layer.end()) {
    Source source = read_preset(preset->second.reading.word, preset->second.place, case_folder);
    inputs.push_back(source.file);
    layer = std::move(source.layer);
    for (const char* of_all : {"law", "criterion", "limits", "rolling_friction", "contact_law",
                               "shear_residual", "shear_under_yield"})
      layer.erase(std::string(material_prefix) + of_all);
    std::erase_if(layer, [&](const auto& entry) { return is_foreign(entry.first, facts_of(law)); });
  }
  lay_over(layer, group.layer);
  layer.erase("material.preset");
  return layer;
}

void refuse_foreign_keys(const Layer& given, const std::string& law) {
  const LawFacts& facts = facts_of(law);
  for (const auto& [name, value] : given)
    if (is_foreign(name, facts))
      refuse(value.place, name,
             fmt::format("law {} has no {}; leave it out", quote(law), name.substr(material_prefix.size())));
}

Material make_material(const Layer& layer, const FeatureCase& features, Elasticity elasticity,
                       const std::string& file) {
  const LawFacts& law = facts_of(law_of(layer));
  const auto need = [&](const char* name, const char* otherwise = nullptr, const char* unless = nullptr) {
    const std::string full = std::string("material.") + name;
    if (layer.contains(full)) return;
    if (const Key* key = find_key(full))
      for (const Key* other : rivals(*key))
        if (layer.contains(other->name)) return;
    const std::string or_else = otherwise ? fmt::format(" (or {})", otherwise) : "";
    const std::string or_off = unless ? fmt::format(", or set features.{} = false", unless) : "";
    refuse(file, full + or_else, fmt::format("missing; give it, or a material.preset{}", or_off));
  };
  const auto need_of_law = [&](const char* name, const char* otherwise, const char* unless) {
    if (law.has(name)) need(name, otherwise, unless);
  };
  const bool by_stiffness = law.has("normal_stiffness");  // of each bond, not of the specimen
  need("density");
  if (!by_stiffness) {
    need("young_modulus");
    need("poisson_ratio");
  }
  need("friction_dynamic");
  if (features.plasticity) {
    need_of_law("limit_compressive_stress", nullptr, "plasticity");
    need_of_law("stiffness_reduction", nullptr, "plasticity");
  }
  if (features.breakage) {
    need_of_law("friction_static", nullptr, "breakage");
    need_of_law("tensile_strength", nullptr, "breakage");
    need_of_law("shear_strength", nullptr, "breakage");
    need_of_law("damage_normal", "fracture_energy_normal", "breakage");
    need_of_law("damage_shear", "fracture_energy_shear", "breakage");
  }
  Material material;
  for (const LawParameter& own : law.own) need(std::string(own.key).c_str());
  for (const auto& [name, given] : layer) {
    const Key* key = find_key(name);
    if (!key) continue;
    const std::string_view word = key->name.substr(material_prefix.size());
    if (key->store_material)
      key->store_material(material, given.reading);
    else if (key->law == law.name)
      material.own[std::string(word)] = given.reading.number;
  }
  if (by_stiffness && !layer.contains("material.young_modulus"))
    material.young_modulus = material.own.at("normal_stiffness");  // per metre: for wave speeds only
  if (material.unloading_modulus && *material.unloading_modulus < material.young_modulus)
    refuse(layer.find("material.unloading_modulus")->second.place, "material.unloading_modulus",
           fmt::format("must be at least material.young_modulus, {} GPa, not {}: a bond would give back more "
                       "than it took up",
                       1e-9 * material.young_modulus, 1e-9 * *material.unloading_modulus));
  if (material.yield_stress && *material.yield_stress < material.limit_compressive_stress[0])
    refuse(layer.find("material.yield_stress")->second.place, "material.yield_stress",
           fmt::format("must be at least the first limit_compressive_stress, {} MPa, not {}: below it a bond "
                       "is elastic",
                       1e-6 * material.limit_compressive_stress[0], 1e-6 * *material.yield_stress));
  // (B16): kappa = (1 - 4 nu)/(1 + nu) falls to zero there
  constexpr double largest = 0.25;
  if (elasticity == Elasticity::matched && !by_stiffness && material.poisson_ratio > largest)
    refuse(layer.find("material.poisson_ratio")->second.place, "material.poisson_ratio",
           fmt::format("must be at most {} with bonds.elasticity = \"matched\", not {}", largest,
                       material.poisson_ratio));
  return material;
}

}  // namespace breccia
