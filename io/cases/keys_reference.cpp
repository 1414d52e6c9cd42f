#include "io/cases/keys_reference.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "io/cases/accuracy.hpp"
#include "io/cases/impact_keys.hpp"
#include "io/cases/keys_material.hpp"
#include "io/cases/keys_write.hpp"
#include "kernels/laws/bond_laws.hpp"

namespace breccia {
namespace {

constexpr std::array<std::string_view, 8> tests{"ucs",         "triaxial", "bts",   "usc",
                                                "hydrostatic", "tension",  "shear", "biaxial"};
/// Of the tests and breccia-pack, those whose scenes may have two dimensions.
constexpr std::array<std::string_view, 5> tests_in_plane{"ucs", "bts", "tension", "biaxial", "pack"};

std::string_view table_of(const Key& key) { return key.name.substr(0, key.name.rfind('.')); }
std::string_view word_of(const Key& key) { return key.name.substr(key.name.rfind('.') + 1); }

bool has_plane(std::string_view test) {
  return std::find(tests_in_plane.begin(), tests_in_plane.end(), test) != tests_in_plane.end();
}

/// Two dimensions where the case does not say otherwise.
Space usual_space(std::string_view test) {
  return default_text_of(*find_key("specimen.dimensions"), test) == "2" ? Space::two_d : Space::three_d;
}

std::string code(std::string_view text) { return fmt::format("`{}`", text); }

/// A cell of a table in markdown: no star begins an emphasis, no bar ends the cell.
std::string cell(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '*' || c == '|') result += '\\';
    result += c;
  }
  return result;
}

/// The default of a key, and below it each condition under which it is another.
std::string all_defaults(const Key& key) {
  std::string text = key.default_text.empty() ? "none" : code(key.default_text);
  for (const std::string_view test : tests) {
    if (!accepts(key, test) || usual_space(test) == Space::two_d) continue;
    const std::string_view own = default_text_of(key, test);
    if (own != key.default_text)
      text += fmt::format("; {} {}", test, own.empty() ? "none: must be given" : code(own));
  }
  for (const ConditionalDefault& other : conditional_defaults(key, ""))
    text += fmt::format("; {} {} {}", other.kind, other.of, code(other.value));
  for (const std::string_view test : tests) {
    if (!accepts(key, test) || usual_space(test) == Space::three_d) continue;
    const std::string_view own = default_text_of(key, test, Space::two_d);
    if (own != key.default_text && own != key.default_2d) text += fmt::format("; {} {}", test, code(own));
  }
  return text;
}

/// Programs that take a key: all of them, all but some, or the few that do.
std::string takers(const Key& key) {
  std::vector<std::string_view> with, without;
  for (const std::string_view test : tests) (accepts(key, test) ? with : without).push_back(test);
  std::string text = without.empty()                ? "all tests"
                     : without.size() < with.size() ? fmt::format("all but {}", fmt::join(without, ", "))
                                                    : fmt::format("{}", fmt::join(with, ", "));
  if (key.name.starts_with("specimen.") && accepts(key, "pack")) text += ", pack";
  return text;
}

/// Bond laws that use a key of the material.
std::string laws_of(const Key& key) {
  std::vector<std::string_view> with;
  std::size_t count = 0;
  for_each_law([&]<class Law>(const Law&) {
    ++count;
    if (facts_of(Law::name).has(word_of(key))) with.push_back(Law::name);
  });
  return with.empty() || with.size() == count ? "all" : fmt::format("{}", fmt::join(with, ", "));
}

/// The default of a test in one line of --help: "0.8; fast: 0.95; reference: 0.4".
std::string describe_default(const Key& key, std::string_view test) {
  const std::string_view usual = default_text_of(key, test, usual_space(test));
  std::string text(usual.empty() ? "-" : usual);
  for (const ConditionalDefault& other : conditional_defaults(key, test))
    text += fmt::format("; {}: {}", other.of, other.value);
  return text;
}

void add_row(std::string& text, std::string_view name, std::string_view valid, std::string_view default_text,
             std::string_view who, std::string_view meaning) {
  text += fmt::format("| {} | {} | {} | {} | {} |\n", code(name), cell(valid), cell(default_text), who,
                      cell(meaning));
}

void add_heading(std::string& text, std::string_view table, std::string_view who) {
  text +=
      fmt::format("\n### {}\n\n| key | valid | default | {} | meaning |\n| --- | --- | --- | --- | --- |\n",
                  code(table), who);
}

template <class T>
void add_fields(std::string& text, std::span<const Field<T>> fields, std::string_view left,
                std::string_view right) {
  std::string_view table;
  for (const Field<T>& field : fields) {
    const Key& key = field.key;
    if (table_of(key) != table) {
      table = table_of(key);
      add_heading(text, fmt::format("{}{}{}", left, table, right), "of");
    }
    const std::string default_text = field.required             ? "none: must be given"
                                     : key.default_text.empty() ? "none"
                                                                : code(key.default_text);
    add_row(text, word_of(key), describe_values(key), default_text, field.kinds.empty() ? "all" : field.kinds,
            key.meaning);
  }
}

}  // namespace

std::vector<ConditionalDefault> conditional_defaults(const Key& key, std::string_view test) {
  std::vector<ConditionalDefault> all;
  if (!key.default_2d.empty() && (test.empty() || has_plane(test)) &&
      (test.empty() ||
       default_text_of(key, test, Space::two_d) != default_text_of(key, test, usual_space(test))))
    all.push_back({"in", "2-D", key.default_2d});
  for_each_law([&]<class Law>(const Law&) {
    for (const LawDefault& one : Law::defaults)
      if (one.key == key.name) all.push_back({"law", std::string(Law::name), one.value});
  });
  for (const std::string& word : split_words(find_key("time.accuracy")->words))
    for (const RecipeDefault& one : accuracy_recipe(word))
      if (one.key == key.name) all.push_back({"accuracy", word, one.value});
  return all;
}

std::string describe_keys(const std::string& test) {
  std::string text =
      fmt::format("keys of a case for breccia-{} (a quantity: \"3.8 GPa\", or a bare number in SI)\n", test);
  std::string_view table;
  for (const Key& key : all_keys()) {
    if (!accepts(key, test) || (test == "pack" && !key.name.starts_with("specimen."))) continue;
    if (table_of(key) != table) table = table_of(key), text += fmt::format("\n[{}]\n", table);
    text += fmt::format("  {:<25} {:<44} {:<12} {}\n", word_of(key), describe_values(key),
                        describe_default(key, test), key.meaning);
    if (key.name == "material.preset" && accepts(*find_key("test.confinement"), test))
      text += fmt::format("  {:<25} {:<44} {:<12} {}\n", "[[at]] confinement", "a stress", "-",
                          "a table [[material.at]]: keys of the material for one confinement; between two of "
                          "them, and zero, values lie on straight lines; beyond the last one that one's hold, "
                          "with a warning");
  }
  return text;
}

std::string case_reference() {
  std::string text;
  std::string_view table;
  for (const Key& key : all_keys()) {
    const bool material = table_of(key) == "material";
    if (table_of(key) != table) {
      table = table_of(key);
      add_heading(text, fmt::format("[{}]", table), material ? "laws" : "programs");
    }
    add_row(text, word_of(key), describe_values(key), all_defaults(key),
            material ? laws_of(key) : takers(key), key.meaning);
  }
  return text;
}

std::string impact_reference() {
  std::string text;
  add_fields(text, scene_fields(), "[", "]");
  add_fields(text, material_fields(), "[", ".NAME]");
  add_fields(text, particle_fields(), "[[", "]]");
  add_fields(text, wall_fields(), "[[", "]]");
  return text;
}

}  // namespace breccia
