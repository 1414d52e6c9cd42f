#include "io/cases/keys_write.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "io/cases/accuracy.hpp"
#include "io/cases/keys_material.hpp"
#include "io/text/suggest.hpp"
#include "kernels/laws/bond_laws.hpp"

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

/// Only what confinements change, so that a reader sees it; what one of them changes stands at each, since values
/// between two confinements lie between theirs. Zero may be left out: it has the values of the base.
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
    text += fmt::format("\n[[material.at]]{}{}\nconfinement = {}\n{}", at.place.empty() ? "" : "  # ", at.place,
                        toml_string(confinement), lines);
  }
}

std::string_view word_of_name(std::string_view name) { return name.substr(name.rfind('.') + 1); }

/// The default of a test, and who has another: a law, a recipe, a scene in two dimensions.
std::string describe_standard(const Key& key, const std::string& test) {
  const std::string_view standard = default_text_of(key, test), plane = default_text_of(key, test, Space::two_d);
  std::string text(standard.empty() ? "-" : standard);
  const auto other = [&](std::string_view value, std::string_view whose) {
    if (!value.empty() && value != standard) text += fmt::format("; {}: {}", whose, value);
  };
  other(plane, "2-D");
  if (test == "pack") return text;
  for_each_law([&]<class Law>(const Law&) {
    for (const LawDefault& of_law : Law::defaults)
      if (of_law.key == key.name) other(of_law.value, Law::name);
  });
  for (const std::string& recipe : split_words(find_key("time.accuracy")->words))
    for (const RecipeDefault& of_recipe : accuracy_recipe(recipe))
      if (of_recipe.key == key.name) other(of_recipe.value, recipe);
  return text;
}

}  // namespace

std::string describe_values(const Key& key) {
  switch (key.kind) {
    case Kind::boolean:
      return key.reserved == "true" ? "false" : "true, false";
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
    range += fmt::format(" ({} {}: {})", word_of_name(key.where.key), key.where.value,
                         describe(key.where.range, key.dimension));
  const std::string what = key.kind == Kind::whole_number ? "a whole number" : describe(key.dimension);
  const std::string list = key.kind != Kind::quantities ? ""
                           : key.count                  ? fmt::format("{} x ", key.count)
                                                        : "list of ";
  return list + what + (range.empty() ? "" : ", ") + range + (key.rising ? ", rising" : "");
}

std::string write_case(const Layer& keys, const Layer& base, const std::vector<ConfinementLayer>& at,
                       const std::string& test) {
  std::string text = fmt::format("# breccia-{}: the case with every default written out\n", test);
  std::string_view table;
  const auto end_material = [&] {
    if (table == "material") write_at(text, at, base);
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

std::string describe_keys(const std::string& test) {
  std::string text =
      fmt::format("keys of a case for breccia-{} (a quantity: \"3.8 GPa\", or a bare number in SI)\n", test);
  std::string_view table;
  for (const Key& key : all_keys()) {
    if (!accepts(key, test) || (test == "pack" && !key.name.starts_with("specimen."))) continue;
    if (table_of(key) != table) table = table_of(key), text += fmt::format("\n[{}]\n", table);
    text += fmt::format("  {:<25} {:<44} {:<12} {}\n", word_of(key), describe_values(key),
                        describe_standard(key, test), key.meaning);
    if (key.name == "material.preset" && accepts(*find_key("test.confinement"), test))
      text += fmt::format("  {:<25} {:<44} {:<12} {}\n", "[[at]] confinement", "a stress", "-",
                          "a table [[material.at]]: keys of the material for one confinement; between two of "
                          "them, and zero, values lie on straight lines; beyond the last one that one's hold, "
                          "with a warning");
  }
  return text;
}

}  // namespace breccia
