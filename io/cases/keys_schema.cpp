#include "io/cases/keys_schema.hpp"

#include <algorithm>

#include "core/base/error.hpp"

namespace breccia {

const Key* find_key(std::string_view name) {
  const auto at =
      std::find_if(all_keys().begin(), all_keys().end(), [&](const Key& key) { return key.name == name; });
  return at == all_keys().end() ? nullptr : &*at;
}

const Key* rival(const Key& key) {
  if (!key.instead_of.empty()) return find_key(key.instead_of);
  const auto at = std::find_if(all_keys().begin(), all_keys().end(),
                               [&](const Key& k) { return k.instead_of == key.name; });
  return at == all_keys().end() ? nullptr : &*at;
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

bool accepts(const Key& key, std::string_view test) {
  const auto refused = split_words(key.not_for);
  return std::find(refused.begin(), refused.end(), test) == refused.end();
}

std::string_view default_text_of(const Key& key, std::string_view test, Space space) {
  for (std::string_view rest = key.standard_for; !rest.empty();) {
    const std::string_view one = rest.substr(0, rest.find(' '));
    rest.remove_prefix(std::min(one.size() + 1, rest.size()));
    const std::size_t equals = one.find('=');
    if (one.substr(0, equals) == test) return one.substr(equals + 1);
  }
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
