#include "io/cases/keys_layer.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/bonding/several_materials.hpp"
#include "io/text/suggest.hpp"
#include "io/text/text_file.hpp"

namespace breccia {
namespace {

constexpr std::string_view material = "material.", at_tables = "material.at", group_tables = "material.group",
                           pack = "specimen.pack.";
constexpr Key at_confinement{
    .name = "material.at.confinement", .dimension = dimension::stress, .range = {.low = 0}};
constexpr Key group_number{
    .name = "material.group.group", .kind = Kind::whole_number, .range = {.low = 1, .high = 1e9}};

std::string last_part(std::string_view name) { return std::string(name.substr(name.rfind('.') + 1)); }

bool is_table_name(const std::string& name) {
  const auto keys = all_keys();
  return std::any_of(keys.begin(), keys.end(),
                     [&](const Key& key) { return key.name.starts_with(name + "."); });
}

/// Walks the tables of one file. In a preset `shown` drops "material." from the names that a user
/// reads.
struct Walker {
  std::string test;
  bool preset = false;
  Source source{};

  std::string shown(const std::string& name) const { return preset ? name.substr(material.size()) : name; }

  /// Names of the keys and tables right below a table, as a user reads them.
  std::vector<std::string> names_below(const std::string& prefix) const {
    std::vector<std::string> names;
    for (const std::string& key : key_names(test)) {
      if (!key.starts_with(prefix) || (preset && key == "material.preset")) continue;
      const std::string name = shown(key.substr(0, key.find('.', prefix.size())));
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    if (prefix == material) names.push_back(preset ? "at" : std::string(at_tables));
    if (prefix == material && !preset) names.push_back(std::string(group_tables));
    if (preset) names.push_back("source");
    return names;
  }

  /// Suggests the nearest name of the same table, else the same word in another table, else all of
  /// the table.
  [[noreturn]] void refuse_unknown(const std::string& name, const std::string& place) const {
    const auto suggested = [&](const std::string& other) {
      refuse(place, shown(name), fmt::format("unknown key; did you mean {}?", quote(other)));
    };
    const std::string prefix = name.substr(0, name.rfind('.') + 1);
    std::vector<std::string> names = names_below(prefix);
    std::vector<std::string> words;
    for (const std::string& other : names) words.push_back(last_part(other));
    if (const std::string best = nearest(last_part(name), words); !best.empty())
      suggested(shown(prefix + best));
    if (!preset)
      for (const std::string& key : key_names(test))
        if (last_part(key) == last_part(name)) suggested(key);
    if (names.empty()) names = names_below("");
    refuse(place, shown(name), "unknown key; valid: " + quote_list(names));
  }

  void take(const Key& key, const TomlNode& node, Layer& layer) const {
    if (!accepts(key, test)) refuse(node.place, key.name, fmt::format("{}; leave it out", key.reason));
    try {
      layer[std::string(key.name)] = {read_value(key, node), node.place};
    } catch (const BadInput& error) {
      if (!preset) throw;
      std::string text = error.what();  // a preset has no [material] around its keys
      if (const auto found = text.find(material); found != std::string::npos)
        text.erase(found, material.size());
      throw BadInput(text);
    }
  }

  void walk(const TomlTable& table, const std::string& prefix, Layer& layer) {
    for (const auto& [word, node] : table) {
      const std::string name = prefix + word;
      const Key* key = find_key(name);
      if (name == at_tables) {
        read_at(node);
      } else if (name == group_tables && !preset) {
        read_groups(node);
      } else if (preset && word == "source" && prefix == material) {
        if (!std::holds_alternative<std::string>(node.value)) refuse(node.place, word, "a string is wanted");
      } else if (key && !(preset && word == "preset")) {
        take(*key, node, layer);
      } else if (is_table_name(name) && std::holds_alternative<TomlTable>(node.value)) {
        walk(std::get<TomlTable>(node.value), name + ".", layer);
      } else if (is_table_name(name)) {
        refuse(node.place, name, fmt::format("a table is wanted: [{}]", name));
      } else {
        refuse_unknown(name, node.place);
      }
    }
  }

  void read_at(const TomlNode& node) {
    const std::string name = preset ? "at" : std::string(at_tables);
    const auto* array = std::get_if<TomlArray>(&node.value);
    if (!array) refuse(node.place, name, fmt::format("write [[{}]], once for each confinement", name));
    auto& result = source.at.emplace();
    for (const TomlNode& entry : *array) {
      const auto* table = std::get_if<TomlTable>(&entry.value);
      if (!table) refuse(entry.place, name, fmt::format("write [[{}]], once for each confinement", name));
      ConfinementLayer group{-1, {}, entry.place};
      TomlTable others;
      for (const auto& [word, child] : *table) {
        if (word == "confinement")
          group.confinement = read_value(at_confinement, child).number, group.place = child.place;
        else if (word == "preset" || word == "at" || word == "law" || word == "criterion")
          refuse(child.place, name + "." + word, "not for one confinement; it belongs to the whole material");
        else
          others.push_back({word, child});
      }
      if (group.confinement < 0)
        refuse(entry.place, name, "confinement is missing; name the one that these keys are for");
      if (find_confinement(result, group.confinement))
        refuse(
            group.place, name,
            format_quantity(group.confinement, dimension::stress) + " is given twice; join the two tables");
      walk(others, std::string(material), group.layer);
      check_rivals(group.layer);
      result.push_back(std::move(group));
    }
  }

  void read_groups(const TomlNode& node) {
    const std::string name(group_tables);
    constexpr std::string_view of_all[] = {"at",
                                           "law",
                                           "criterion",
                                           "limits",
                                           "group",
                                           "rolling_friction",
                                           "contact_law",
                                           "shear_residual",
                                           "shear_under_yield"};
    const auto* array = std::get_if<TomlArray>(&node.value);
    if (!array) refuse(node.place, name, fmt::format("write [[{}]], once for each group", name));
    for (const TomlNode& entry : *array) {
      const auto* table = std::get_if<TomlTable>(&entry.value);
      if (!table) refuse(entry.place, name, fmt::format("write [[{}]], once for each group", name));
      GroupLayer group{0, {}, entry.place};
      TomlTable others;
      for (const auto& [word, child] : *table) {
        if (word == "group")
          group.group = static_cast<int>(read_value(group_number, child).whole), group.place = child.place;
        else if (std::find(std::begin(of_all), std::end(of_all), word) != std::end(of_all))
          refuse(child.place, name + "." + word, "not for one group; it belongs to the whole material");
        else
          others.push_back({word, child});
      }
      if (group.group == 0)
        refuse(entry.place, name,
               "group is missing; name the one that these keys are for, as the specimen has it");
      if (std::any_of(source.groups.begin(), source.groups.end(),
                      [&](const GroupLayer& other) { return other.group == group.group; }))
        refuse(group.place, name, fmt::format("group {} is given twice; join the two tables", group.group));
      if (source.groups.size() + 1 == most_materials)
        refuse(group.place, name, fmt::format("at most {} of them", most_materials - 1));
      walk(others, std::string(material), group.layer);
      check_rivals(group.layer);
      source.groups.push_back(std::move(group));
    }
  }

  void check_rivals(const Layer& layer) const {
    for (const Key& key : all_keys()) {
      if (key.instead_of.empty()) continue;
      for (const Key* rival : rivals(key)) {
        const auto one = layer.find(key.name), other = layer.find(rival->name);
        if (one != layer.end() && other != layer.end())
          refuse(one->second.place, shown(one->first),
                 fmt::format("excludes {}; give one of the two", shown(other->first)));
      }
    }
    const auto file = layer.find("specimen.file"), packed = layer.lower_bound(pack);
    if (file != layer.end() && packed != layer.end() && packed->first.starts_with(pack))
      refuse(packed->second.place, packed->first, "excludes specimen.file; give one of the two");
  }
};

}  // namespace

Source read_case_source(const TomlNode& root, const std::string& test) {
  Walker walker{test};
  walker.walk(std::get<TomlTable>(root.value), "", walker.source.layer);
  walker.check_rivals(walker.source.layer);
  return walker.source;
}

Source read_preset_source(const TomlNode& root) {
  Walker walker{"", true};
  walker.walk(std::get<TomlTable>(root.value), std::string(material), walker.source.layer);
  walker.check_rivals(walker.source.layer);
  return walker.source;
}

Source read_set_source(const std::vector<std::string>& sets, const std::string& test) {
  constexpr const char* letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
  Walker all{test};
  for (const std::string& text : sets) {
    const std::size_t equals = text.find('=');
    const std::string name(trim(std::string_view(text).substr(0, equals)));
    if (equals == std::string::npos || name.empty() || name.find_first_not_of(letters) != std::string::npos)
      fail<BadInput>("--set: {}: write --set table.key=value", quote(text));
    TomlNode node = parse_toml_value(text.substr(equals + 1), "--set");
    if (std::holds_alternative<TomlTable>(node.value)) {
      all.source.tables.push_back(name + ".");
      erase_below(all.source.layer, name + ".");
    }
    Walker one{test};
    one.walk({{name, std::move(node)}}, "", one.source.layer);
    lay_over(all.source.layer, one.source.layer);
    if (one.source.at) all.source.at = std::move(one.source.at);
    if (!one.source.groups.empty()) all.source.groups = std::move(one.source.groups);
  }
  return all.source;
}

void erase_below(Layer& layer, std::string_view prefix) {
  std::erase_if(layer, [&](const auto& entry) { return entry.first.starts_with(prefix); });
}

void lay_over(Layer& low, const Layer& high) {
  for (const auto& [name, given] : high) {
    const Key* key = find_key(name);
    if (key)
      for (const Key* other : rivals(*key))
        if (!high.contains(other->name)) low.erase(std::string(other->name));
    if (name == "specimen.file" || name.starts_with(pack)) low.erase("specimen.sha256");
    if (name == "specimen.file") erase_below(low, pack);
    if (name.starts_with(pack)) low.erase("specimen.file");
    low[name] = given;
  }
}

bool same_confinement(double a, double b) {
  constexpr double tolerance = 1e-6;  // 500 psi and 3.44738 MPa are meant to be the same
  return std::abs(a - b) <= tolerance * std::max(std::abs(a), std::abs(b));
}

const Layer* find_confinement(const std::vector<ConfinementLayer>& groups, double confinement) {
  for (const ConfinementLayer& group : groups)
    if (same_confinement(group.confinement, confinement)) return &group.layer;
  return nullptr;
}

}  // namespace breccia
