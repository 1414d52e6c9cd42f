#include "io/reference/keys_reference.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/loading/laboratory_tests.hpp"
#include "io/cases/accuracy.hpp"
#include "io/cases/keys_material.hpp"
#include "io/cases/keys_write.hpp"
#include "io/reference/keys_markdown.hpp"
#include "kernels/laws/bond_laws.hpp"

namespace breccia {
namespace {

/// Whether scenes of a test, or packings, may have two dimensions.
bool has_plane(std::string_view program) {
  const LaboratoryTest* test = find_laboratory_test(program);
  return !test || test->two_d;
}

/// Two dimensions where the case does not say otherwise.
Space usual_space(std::string_view test) {
  return default_text_of(*find_key("specimen.dimensions"), test) == "2" ? Space::two_d : Space::three_d;
}

/// The default of a key, and below it each condition under which it is another.
std::string all_defaults(const Key& key) {
  std::string text = key.default_text.empty() ? "none" : code(key.default_text);
  for (const LaboratoryTest& row : laboratory_tests) {
    const std::string_view test = row.name;
    if (!accepts(key, test) || usual_space(test) == Space::two_d) continue;
    const std::string_view own = default_text_of(key, test);
    if (own != key.default_text)
      text += fmt::format("; {} {}", test, own.empty() ? "none: must be given" : code(own));
  }
  for (const ConditionalDefault& other : conditional_defaults(key, ""))
    text += fmt::format("; {} {} {}", other.kind, other.of, code(other.value));
  for (const LaboratoryTest& row : laboratory_tests) {
    const std::string_view test = row.name;
    if (!accepts(key, test) || usual_space(test) == Space::three_d) continue;
    const std::string_view own = default_text_of(key, test, Space::two_d);
    if (own != key.default_text && own != key.default_2d) text += fmt::format("; {} {}", test, code(own));
  }
  return text;
}

/// Programs that take a key: all of them, all but some, or the few that do.
std::string takers(const Key& key) {
  std::vector<std::string_view> with, without;
  for (const LaboratoryTest& test : laboratory_tests)
    (accepts(key, test.name) ? with : without).push_back(test.name);
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
    if (!accepts(key, test) || (takes_specimen_only(test) && !key.name.starts_with("specimen."))) continue;
    if (table_of(key) != table) table = table_of(key), text += fmt::format("\n[{}]\n", table);
    text += fmt::format("  {:<25} {:<44} {:<12} {}\n", word_of(key), describe_values(key),
                        describe_default(key, test), key.meaning);
    if (key.name == "material.preset" && find_laboratory_test(test))
      text +=
          fmt::format("  {:<25} {:<44} {:<12} {}\n", "[[group]] group", "a whole number, from 1", "-",
                      "a table [[material.group]]: keys of the material for one cohesive group of spheres");
    if (key.name == "material.preset" && accepts(*find_key("test.confinement"), test))
      text +=
          fmt::format("  {:<25} {:<44} {:<12} {}\n", "[[at]] confinement", "a stress", "-",
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

}  // namespace breccia
