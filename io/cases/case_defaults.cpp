#include "io/cases/case_defaults.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/cases/accuracy.hpp"
#include "io/cases/keys_material.hpp"
#include "io/cases/keys_write.hpp"

namespace breccia {
namespace {

bool is_pack(std::string_view name) { return name.starts_with("specimen.pack."); }

bool gives_pack(const Layer& layer) {
  return std::any_of(layer.begin(), layer.end(), [](const auto& entry) { return is_pack(entry.first); });
}

}  // namespace

bool is_material(std::string_view key) { return key.starts_with("material."); }

bool takes_standard(const Key& key, const Layer& layer, std::string_view program) {
  if (layer.contains(key.name) || is_material(key.name) || default_text_of(key, program).empty())
    return false;
  if (!accepts(key, program) || (takes_specimen_only(program) && !key.name.starts_with("specimen.")))
    return false;
  for (const Key* other : rivals(key))
    if (layer.contains(other->name)) return false;
  if (!is_pack(key.name)) return true;
  if (key.name == "specimen.pack.porosity" && layer.contains("specimen.pack.genesis_pressure")) return false;
  if (key.name == "specimen.pack.sizes.spread") {
    const auto kind = layer.find("specimen.pack.sizes.kind");
    if (kind != layer.end() && kind->second.reading.word == "sieves") return false;
  }
  return gives_pack(layer);
}

Standard Standards::of(const Key& key) const {
  if (rolls && key.name == "run.precision") return {"double", "material.rolling_friction"};
  for (const RecipeDefault& default_text : accuracy_recipe(accuracy))
    if (default_text.key == key.name) return {default_text.value, "time.accuracy"};
  for (const LawDefault& default_text : facts_of(law).defaults)
    if (default_text.key == key.name) return {default_text.value, "material.law"};
  for (const LawParameter& own : facts_of(law).own)
    if (key.name == fmt::format("material.{}", own.key)) return {own.default_text, "material.law"};
  const std::string_view value = default_text_of(key, program, space);
  if (value == key.default_text) return {value, ""};
  return {value, default_text_of(key, program) == value ? "this test" : "specimen.dimensions"};
}

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

}  // namespace breccia
