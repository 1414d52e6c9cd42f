#include "io/cases/changed_keys.hpp"

#include <fmt/format.h>

#include <map>
#include <sstream>

namespace breccia {
namespace {

const std::string digest = "specimen.sha256";

bool may_differ(const std::string& key) {
  return key == "run.checkpoint_every" || key == digest || key.starts_with("output.");
}

/// Values by table.key. A resolved case has one key a line; an array of tables counts its elements.
std::map<std::string, std::string> values_of(const std::string& text) {
  std::map<std::string, std::string> values;
  std::map<std::string, int> elements;
  std::istringstream in(text);
  std::string table, line;
  while (std::getline(in, line)) {
    if (line.starts_with("[[")) {
      const std::string name = line.substr(2, line.find(']') - 2);
      table = fmt::format("{}[{}]", name, elements[name]++);
    } else if (line.starts_with('[')) {
      table = line.substr(1, line.find(']') - 1);
    } else if (const std::size_t equals = line.find(" = "); equals != std::string::npos && line[0] != '#') {
      values[table + '.' + line.substr(0, equals)] = line.substr(equals + 3);
    }
  }
  return values;
}

}  // namespace

bool has_same_specimen(const std::string& before, const std::string& now) {
  const auto old_values = values_of(before), new_values = values_of(now);
  const auto was = old_values.find(digest), is = new_values.find(digest);
  return was == old_values.end() || is == new_values.end() || was->second == is->second;
}

std::vector<std::string> changed_keys(const std::string& before, const std::string& now) {
  auto old_values = values_of(before), new_values = values_of(now);
  if (has_same_specimen(before, now) && old_values.contains(digest)) {  // wherever it lies
    old_values.erase("specimen.file");
    new_values.erase("specimen.file");
  }
  std::vector<std::string> changed;
  for (const auto& [key, value] : new_values) {
    const auto old = old_values.find(key);
    if (may_differ(key) || (old != old_values.end() && old->second == value)) continue;
    changed.push_back(
        fmt::format("{} = {}, was {}", key, value, old == old_values.end() ? "absent" : old->second));
  }
  for (const auto& [key, value] : old_values)
    if (!may_differ(key) && !new_values.contains(key))
      changed.push_back(fmt::format("{} absent, was {}", key, value));
  return changed;
}

}  // namespace breccia
