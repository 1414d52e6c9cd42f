#include "io/cases/keys_schema.hpp"

#include <algorithm>

#include "core/base/error.hpp"

namespace breccia {

const Key* find_key(std::string_view name) {
  const auto at =
      std::find_if(all_keys().begin(), all_keys().end(), [&](const Key& key) { return key.name == name; });
  return at == all_keys().end() ? nullptr : &*at;
}

std::vector<const Key*> rivals(const Key& key) {
  const std::string_view first = key.instead_of.empty() ? key.name : key.instead_of;
  std::vector<const Key*> others;
  for (const Key& k : all_keys())
    if ((k.name == first || k.instead_of == first) && k.name != key.name) others.push_back(&k);
  return others;
}

std::vector<std::string> split_words(std::string_view words) {
  std::vector<std::string> result;
  while (!words.empty()) {
    const std::size_t length = std::min(words.find(' '), words.size());
    result.emplace_back(words.substr(0, length));
    words.remove_prefix(std::min(length + 1, words.size()));
  }
  return result;
}

bool takes_specimen_only(std::string_view program) { return !find_laboratory_test(program); }

bool accepts(const Key& key, std::string_view program) {
  const LaboratoryTest* const test = find_laboratory_test(program);
  if (!test) return key.packs;
  return !key.refused_by || !key.refused_by(*test);
}

std::string_view default_text_of(const Key& key, std::string_view program, Space space) {
  if (const LaboratoryTest* const test = find_laboratory_test(program); test && key.default_of)
    if (const auto own = key.default_of(*test)) return *own;
  return space == Space::two_d && !key.default_2d.empty() ? key.default_2d : key.default_text;
}

std::vector<std::string> key_names(std::string_view test, std::string_view table) {
  std::vector<std::string> names;
  for (const Key& key : all_keys()) {
    const std::string_view of = key.name.substr(0, key.name.rfind('.'));
    if (accepts(key, test) && (table.empty() || table == of)) names.emplace_back(key.name);
  }
  return names;
}

std::string describe(const Range& range, Dimension d) {
  const bool low = range.low > -1e300, high = range.high < 1e300;
  const std::string from = format_quantity(range.low, d), to = format_quantity(range.high, d);
  if (low && high)
    return fmt::format("{} {} {} {}", range.low_open ? "above" : "from", from,
                       range.high_open ? "to below" : "to", to);
  if (low) return fmt::format("{} {}", range.low_open ? "more than" : "at least", from);
  if (high) return fmt::format("{} {}", range.high_open ? "below" : "at most", to);
  return "";
}

}  // namespace breccia
