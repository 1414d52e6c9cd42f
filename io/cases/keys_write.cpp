#include "io/cases/keys_write.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "io/text/suggest.hpp"

namespace breccia {
namespace {

std::string_view table_of(const Key& key) { return key.name.substr(0, key.name.rfind('.')); }
std::string_view word_of(const Key& key) { return key.name.substr(key.name.rfind('.') + 1); }

void write_line(std::string& text, const Key& key, const Reading& reading) {
  text += fmt::format("{} = {}\n", word_of(key), write_value(key, reading));
}

/// Whether a confinement changes what stands behind a key.
bool differs(const Key& key, const Layer& at, const Layer& base) {
  const auto here = at.find(key.name), there = base.find(key.name);
  return here != at.end() && (there == base.end() || write_value(key, here->second.reading) !=
                                                         write_value(key, there->second.reading));
}

/// Only what confinements change, so that a reader sees it; what one of them changes stands at
/// each, since values between two confinements lie between theirs. Zero may be left out: it has the
/// values of the base.
void write_at(std::string& text, const std::vector<ConfinementLayer>& groups, const Layer& base) {
  std::vector<const Key*> changed;
  for (const Key& key : all_keys())
    if (std::any_of(groups.begin(), groups.end(),
                    [&](const ConfinementLayer& at) { return differs(key, at.layer, base); }))
      changed.push_back(&key);
  if (changed.empty()) return;
  for (const ConfinementLayer& at : groups) {
    std::string lines;
    bool differ = at.confinement != 0;
    for (const Key* key : changed) {
      differ = differ || differs(*key, at.layer, base);
      if (const auto here = at.layer.find(key->name); here != at.layer.end())
        write_line(lines, *key, here->second.reading);
    }
    if (!differ) continue;
    const std::string confinement = format_quantity(at.confinement, dimension::stress);
    text += fmt::format("\n[[material.at]]{}{}\nconfinement = {}\n{}", at.place.empty() ? "" : "  # ",
                        at.place, toml_string(confinement), lines);
  }
}

void write_groups(std::string& text, const std::vector<GroupLayer>& groups) {
  for (const GroupLayer& group : groups) {
    text += fmt::format("\n[[material.group]]\ngroup = {}\n", group.group);
    for (const Key& key : all_keys())
      if (const auto given = group.layer.find(key.name); given != group.layer.end())
        write_line(text, key, given->second.reading);
  }
}

}  // namespace

std::string describe_values(const Key& key) {
  switch (key.kind) {
    case Kind::boolean:
      return "true, false";
    case Kind::word:
      return quote_list(split_words(key.words));
    case Kind::word_or_number:
      return quote_list(split_words(key.words)) + ", number " + describe(key.range, key.dimension);
    case Kind::text:
      return "text";
    default:
      break;
  }
  std::string range = describe(key.range, key.dimension);
  if (!key.where.key.empty())
    range += fmt::format(" ({} {}: {})", key.where.key.substr(key.where.key.rfind('.') + 1), key.where.value,
                         describe(key.where.range, key.dimension));
  const std::string what = key.kind == Kind::whole_number ? "a whole number" : describe(key.dimension);
  const std::string list = key.kind != Kind::quantities ? ""
                           : key.count                  ? fmt::format("{} x ", key.count)
                                                        : "list of ";
  return list + what + (range.empty() ? "" : ", ") + range + (key.rising ? ", rising" : "");
}

std::string write_case(const Layer& keys, const Layer& base, const std::vector<ConfinementLayer>& at,
                       const std::vector<GroupLayer>& groups, const std::string& test) {
  std::string text = fmt::format("# breccia-{}: the case with every default written out\n", test);
  std::string_view table;
  const auto end_material = [&] {
    if (table != "material") return;
    write_at(text, at, base);
    write_groups(text, groups);
  };
  for (const Key& key : all_keys()) {
    const Layer& layer = table_of(key) == "material" ? base : keys;
    const auto given = layer.find(key.name);
    if (given == layer.end()) continue;
    if (table_of(key) != table) {
      end_material();
      table = table_of(key);
      text += fmt::format("\n[{}]\n", table);
    }
    write_line(text, key, given->second.reading);
  }
  end_material();
  return text;
}

}  // namespace breccia
